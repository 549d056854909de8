// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "files/descriptor.hpp"
#include "study/outcome.hpp"

namespace velum::study {

/// A cell's process: a copy of this one, which has opened the plugins and never runs a stage itself
/// (a child that is forked after an OpenMP region hangs). Ends with this process.
class Process {
 public:
  /// What the work prints goes to `log`, whose folder is made. Throws Error (Fault::output).
  Process(const std::function<Outcome()>& work, const std::filesystem::path& log);
  ~Process();
  Process(Process&&) noexcept;
  Process& operator=(Process&&) = delete;

  /// Becomes readable when the process ends.
  [[nodiscard]] int ended() const { return ended_.get(); }
  /// How it went; only when it has ended.
  Outcome outcome();
  /// Asks it to stop: its run ends as after Ctrl-C.
  void interrupt() const;
  /// Ends it and all that it has started.
  void kill() const;
  [[nodiscard]] double seconds() const;
  /// Resident memory of it and of all that it has started [bytes].
  [[nodiscard]] std::uint64_t resident() const;

 private:
  pid_t pid_ = -1;
  files::Descriptor answer_;
  files::Descriptor ended_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace velum::study
