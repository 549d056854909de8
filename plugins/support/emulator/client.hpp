// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <string>

#include "emulator/device.hpp"
#include "emulator/sockets.hpp"
#include "lms511/frame.hpp"

namespace velum::emulator {

/// One connection: what has come in, what is to go out. Nothing blocks.
class Client {
 public:
  /// Bytes that may wait to be sent. A scan that finds no room is not sent, as on the real device.
  static constexpr std::size_t kRoom = std::size_t{2} << 20U;

  Client(Descriptor socket, lms511::Dialect dialect)
      : socket_(std::move(socket)), framer_(dialect) {
    session.dialect = dialect;
  }
  [[nodiscard]] int descriptor() const { return socket_.get(); }
  /// Takes what has arrived; false when the client is gone.
  [[nodiscard]] bool receive();
  [[nodiscard]] std::optional<lms511::Telegram> request() { return framer_.next(); }

  /// Puts bytes into the queue; with a pause, a piece by itself and that long after the one before.
  void send(std::string bytes, double pause = 0.0);
  /// Sends what can be sent at `now` [s]; false when the client is gone.
  [[nodiscard]] bool flush(double now);
  /// A client that does not read its answers is not heard until it does.
  [[nodiscard]] bool listens() const { return waiting_ < kRoom; }
  [[nodiscard]] std::size_t waiting() const { return waiting_; }
  /// Is there something that could be sent at `now`?
  [[nodiscard]] bool wants_out(double now) const { return waiting_ > 0 && now >= not_before_; }
  [[nodiscard]] double not_before() const { return not_before_; }
  void reset() { emulator::reset(std::move(socket_)); }

  Session session;
  double scans_from = 0.0;  ///< device clock from which scans are sent [us]
  std::uint64_t scans = 0;  ///< sent or spoiled
  bool closing = false;     ///< ends when all is sent
  bool mute = false;        ///< says nothing more

 private:
  struct Piece {
    std::string bytes;
    double pause;
  };
  Descriptor socket_;
  lms511::Framer framer_;
  std::deque<Piece> out_;
  std::size_t sent_ = 0;  ///< of the first piece
  std::size_t waiting_ = 0;
  double not_before_ = 0.0;
};

}  // namespace velum::emulator
