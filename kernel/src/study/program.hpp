// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace velum::study {

/// What a program that has ended said, and its exit status (128 and the signal when it died of
/// one).
struct Said {
  int status = 0;
  std::string out;
  std::string error;
};

/// Runs a program of the search path to its end, in a process group of its own, so that Ctrl-C at
/// the terminal does not reach it. Throws Error (Fault::graph) when it cannot be started.
[[nodiscard]] Said run_program(const std::vector<std::string>& words);

}  // namespace velum::study
