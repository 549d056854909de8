// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <functional>
#include <string>

#include "lms511/reader.hpp"
#include "lms511/socket.hpp"
#include "lms511/writer.hpp"

namespace velum::lms511 {

/// The device said no, by sFA.
class Refused : public std::runtime_error {
 public:
  Refused(ErrorCode code, const std::string& what) : std::runtime_error(what), code_(code) {}
  [[nodiscard]] ErrorCode code() const { return code_; }

 private:
  ErrorCode code_;
};
/// Nothing came in the time for it.
class NoAnswer : public ConnectionLost {
 public:
  using ConnectionLost::ConnectionLost;
};

/// The payload of an answer, kept.
struct Answer {
  Dialect dialect = Dialect::binary;
  std::string payload;
  [[nodiscard]] Reader reader() const { return Reader({dialect, payload}); }
};

/// Telegrams with one device over one connection. One request is outstanding at a time: an sFA does
/// not say which one it answers.
class Session {
 public:
  /// `events` gets what was not asked for, also between a request and its answer.
  using Events = std::function<void(const Telegram&)>;

  Session(TcpSocket socket, Dialect dialect, Events events, Interrupt interrupt)
      : socket_(std::move(socket)),
        framer_(dialect),
        events_(std::move(events)),
        interrupt_(std::move(interrupt)) {}

  /// The answer with the request's name. Throws Refused, NoAnswer, ConnectionLost.
  Answer ask(const Writer& request, double seconds);
  /// Waits at most that long for bytes and passes on the telegrams in them; their number.
  std::size_t pump(double seconds);

  [[nodiscard]] const Framer::Counts& counts() const { return framer_.counts(); }

 private:
  TcpSocket socket_;
  Framer framer_;
  Events events_;
  Interrupt interrupt_;
};

}  // namespace velum::lms511
