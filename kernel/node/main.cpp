// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// velum-node FOLDER: runs one stage as the folder says, for a node with `isolate = true`.
#include <cstdio>
#include <exception>

#include "run/isolate.hpp"

int main(int count, char** arguments) {
  if (count != 2) return 2;
  try {
    return velum::run::isolated_main(arguments[1]);  // NOLINT
  } catch (const std::exception& error) {
    std::fprintf(stderr, "velum-node: %s\n", error.what());
    return 1;
  }
}
