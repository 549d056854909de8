// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace velum::emulator {

/// A file descriptor that is closed with its owner.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor();
  [[nodiscard]] int get() const { return number_; }
  [[nodiscard]] bool open() const { return number_ >= 0; }

 private:
  int number_;
};

/// A port that TCP clients can connect to.
class Listener {
 public:
  /// Port 0 takes any free one. Throws Error (Fault::device) when the port cannot be had.
  Listener(const std::string& address, std::uint16_t port);
  [[nodiscard]] int descriptor() const { return socket_.get(); }
  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// A client that has called, not blocking; not open when there is none.
  [[nodiscard]] Descriptor accept() const;

 private:
  Descriptor socket_;
  std::uint16_t port_ = 0;
};

/// Ends a connection with a reset instead of an orderly close.
void reset(Descriptor socket);

}  // namespace velum::emulator
