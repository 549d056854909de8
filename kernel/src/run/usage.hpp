// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <mutex>

#include "files/descriptor.hpp"

namespace velum::run {

/// Resident memory of a process [bytes]; 0 when it is gone.
std::uint64_t resident_bytes(pid_t process);
/// Processor time of this process [s].
double own_cpu_seconds();
/// Processor time of this process and its ended children [s].
double cpu_seconds();

/// Follows the process's peak of resident memory, whole and since a mark. Thread-safe.
class PeakMeter {
 public:
  PeakMeter();

  /// From now on since_mark() tells the peak from here.
  void mark();
  /// Peak since the last mark [bytes]; 0 where the system cannot tell.
  std::uint64_t since_mark();
  /// Peak since the process began [bytes].
  std::uint64_t whole();

 private:
  std::uint64_t read();

  std::mutex mutex_;
  files::Descriptor status_;  ///< /proc/self/status
  files::Descriptor reset_;   ///< /proc/self/clear_refs
  std::uint64_t whole_ = 0;
};

}  // namespace velum::run
