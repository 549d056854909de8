// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lms511/dialogue.hpp"
#include "lms511/listener.hpp"
#include "lms511/record.hpp"

namespace velum::lms511 {

/// What a sweep begins with.
struct TriggerSettings {
  /// "" at once; "udp:PORT" or "tcp:PORT": a message there; "local:NAME": when `count` scanners of
  /// this process wait under that name.
  std::string source;
  int count = 2;
  double timeout = 60.0;  ///< [s]
  void check() const;
};

/// Said while scanning, at once.
struct AcquireLog {
  std::function<void(const std::string&)> warn;
  std::function<void(const std::string&)> info;
};

/// Runs one scanner: connects, starts it, passes on what comes as records, and connects again when
/// the connection is lost, waiting longer each time. Every connection has its own framing, so that
/// the telegrams of two are never mixed.
class Acquisition {
 public:
  struct Settings {
    DeviceSettings device;
    TriggerSettings trigger;
    std::string feed;  ///< "" or the port of a tilt feed: lines with an angle [deg]
  };

  Acquisition(Settings settings, AcquireLog log, Interrupt interrupt);
  ~Acquisition();

  /// Passes on records until `done` says so, which is asked after each record and at least every
  /// 50 ms. Throws Error (Fault::device) when no line came for timeouts.give_up seconds, and what
  /// the interrupt throws. What was passed on before is sound in any case.
  void run(const RecordSink& sink, const std::function<bool()>& done);

  /// Sums over all connections.
  [[nodiscard]] const Framer::Counts& counts() const { return counts_; }

 private:
  class Connection;
  void arm();
  void attempt(const RecordSink& sink, const std::function<bool()>& done);
  void take_messages(const RecordSink& sink);
  void wait_between(double seconds);
  [[nodiscard]] std::int64_t since_start(SteadyClock::time_point time) const;
  [[nodiscard]] double idle() const;

  Settings settings_;
  AcquireLog log_;
  Interrupt interrupt_;
  SteadyClock::time_point begin_;
  SteadyClock::time_point last_line_;
  Dialect dialect_;
  bool ever_answered_ = false;
  bool armed_ = false;  ///< a usable scan has come: the trigger may
  bool triggered_ = false;
  bool streaming_ = false;  ///< lines came on this connection
  std::shared_ptr<Listener> trigger_;
  std::uint64_t trigger_seen_ = 0;
  std::optional<Rendezvous> rendezvous_;
  SteadyClock::time_point armed_at_;
  std::shared_ptr<Listener> feed_;
  std::uint64_t feed_seen_ = 0;
  Framer::Counts counts_;
};

}  // namespace velum::lms511
