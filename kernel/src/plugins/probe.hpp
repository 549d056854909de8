// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace velum::plugins {

/// What opening a plugin in a child process showed.
struct Probed {
  /// Why the file is in quarantine: opening it ended or hung the child. Empty: it may be opened.
  std::string quarantined;
  /// Why it is refused though opening it is harmless, such as an undefined symbol; else empty.
  std::string refused;
  std::string summary;
  /// The next probe could show something else: the machine was too busy to tell.
  bool uncertain = false;
};

/// How long opening a plugin may take, in time of its own: waiting for what does not come, or
/// computing. Where the machine has no time for it, twelve times as long.
#if defined(VELUM_SANITIZED)
inline constexpr std::chrono::milliseconds kProbeTime{30000};  // sanitizers are slow to begin
#else
inline constexpr std::chrono::milliseconds kProbeTime{5000};
#endif

/// Opens `file` in a child process that does nothing else.
Probed probe_afresh(const std::filesystem::path& file,
                    std::chrono::milliseconds limit = kProbeTime);

/// The same, remembered in the user's cache folder for as long as path, size, time and inode of the
/// file and libvelum itself stay as they are. A file that was only refused is tried each time: what
/// it lacks may have been installed since. A cache that cannot be read or written costs time only.
Probed probe(const std::filesystem::path& file);

/// Throws Error (Fault::plugin) when probe() puts the file into quarantine.
void require_sound(const std::filesystem::path& file);

/// Forgets what is remembered of `file`.
void forget_probe(const std::filesystem::path& file);

/// The child's side: opens `file` and writes what it finds as JSON to the file descriptor `out`.
/// Returns the exit status.
int probe_child(const char* file, int out);

}  // namespace velum::plugins
