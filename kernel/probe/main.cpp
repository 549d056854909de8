// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// velum-probe FILE: opens a plugin and writes what it finds to file descriptor 3. Velum runs it so
// that a plugin that crashes or hangs when it is opened does so here.
#include "plugins/probe.hpp"

int main(int count, char** arguments) {
  constexpr int kAnswer = 3;
  return count == 2 ? velum::plugins::probe_child(arguments[1], kAnswer) : 2;  // NOLINT
}
