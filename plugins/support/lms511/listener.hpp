// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "lms511/socket.hpp"

namespace velum::lms511 {

/// Hears messages on a local UDP or TCP port and notes when each arrived. A message is a datagram,
/// or a line of a TCP connection. Keeps the last 100,000.
class Listener {
 public:
  struct Message {
    SteadyClock::time_point arrival;
    std::string text;
  };

  /// "udp:5000" or "tcp:5000". The listener of a port is shared by all that ask for it. Throws
  /// Error: Fault::graph for what is no port, Fault::device when the port cannot be had.
  static std::shared_ptr<Listener> at(const std::string& port);
  /// Throws Error (Fault::graph) when `port` is neither "udp:N" nor "tcp:N".
  static void check(std::string_view port);

  explicit Listener(const std::string& port);
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// The messages since `seen`, which is moved on.
  [[nodiscard]] std::vector<Message> since(std::uint64_t& seen) const;
  /// How many there were so far: where a newcomer begins.
  [[nodiscard]] std::uint64_t count() const;

 private:
  void hear_datagrams();
  void hear_lines();
  void note(std::string text);

  Handle handle_;
  mutable std::mutex mutex_;
  std::vector<Message> messages_;
  std::uint64_t dropped_ = 0;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// Lets those that wait under one name go on together, when as many as expected are there. Each
/// place is taken once.
class Rendezvous {
 public:
  /// Takes a place of `count` under `name`.
  Rendezvous(std::string name, int count);
  /// When the last one arrived; nothing while some are missing.
  [[nodiscard]] std::optional<SteadyClock::time_point> begun() const;
  [[nodiscard]] int present() const;

 private:
  struct Group;
  std::shared_ptr<Group> group_;
};

}  // namespace velum::lms511
