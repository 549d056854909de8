// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace velum::lms511 {

using SteadyClock = std::chrono::steady_clock;

/// Where a device listens.
struct Endpoint {
  std::string host;
  std::uint16_t port = 0;
};
/// "192.168.0.1", "lms.local:2112", "::1", "[::1]:2112". Throws Error (Fault::graph).
[[nodiscard]] Endpoint parse_endpoint(std::string_view text, std::uint16_t default_port);
[[nodiscard]] std::string in_words(const Endpoint& endpoint);

/// The connection cannot be made or is no more; what() says why. Another attempt may do better.
class ConnectionLost : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Called at least every 50 ms while something is awaited; throws to end it.
using Interrupt = std::function<void()>;

/// Owner of a file descriptor.
class Handle {
 public:
  Handle() = default;
  explicit Handle(int descriptor) : descriptor_(descriptor) {}
  Handle(Handle&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle();
  [[nodiscard]] int get() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

/// A TCP connection that is never waited for without an end.
class TcpSocket {
 public:
  /// Tries each address of the name, IPv6 and IPv4. Throws ConnectionLost.
  static TcpSocket connect(const Endpoint& endpoint, double seconds, const Interrupt& interrupt);

  void send(std::string_view bytes, double seconds, const Interrupt& interrupt);
  /// What has arrived, waiting at most that long for the first byte; empty when nothing did. Valid
  /// until the next call. Throws ConnectionLost when the peer has closed or reset.
  [[nodiscard]] std::string_view receive(double seconds, const Interrupt& interrupt);

 private:
  explicit TcpSocket(Handle handle);
  Handle handle_;
  std::string buffer_;
};

/// Waits until `descriptor` is ready for `events` of poll(2); false when the time is over.
bool wait_for(int descriptor, short events, double seconds, const Interrupt& interrupt);

}  // namespace velum::lms511
