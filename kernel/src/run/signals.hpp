// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

namespace velum::run {

/// Set by the first SIGINT or SIGTERM after catch_signals(); the second one ends the process at
/// once.
const std::atomic<bool>& stop_requested();
void catch_signals();

/// Exit status of an interrupted run.
inline constexpr int kInterrupted = 130;

}  // namespace velum::run
