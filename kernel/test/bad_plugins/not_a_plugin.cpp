// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A shared object like any other.
extern "C" [[gnu::visibility("default")]] int not_a_plugin() {
  return 1;
}
