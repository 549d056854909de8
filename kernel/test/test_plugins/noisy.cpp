// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Prints where only the command may, as libraries do.
#include <cstdio>
#include <velum/stage.hpp>

namespace {

struct Noisy {
  static auto about() { return velum::About<Noisy>("Prints.").in("cloud").out("cloud"); }
  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context&) const {
    std::puts("NOISE");
    std::fflush(stdout);
    return cloud;
  }
};

}  // namespace
VELUM_STAGE(Noisy)
