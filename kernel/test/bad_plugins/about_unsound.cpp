// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A description that breaks several of the rules.
#include <velum/stage.hpp>

namespace {

struct Unsound {
  double size = -1.0;
  int count = 3;

  static auto about() {
    return velum::About<Unsound>("")
        .in("cloud")
        .needs_when("metric", "plane", "cloud", "normals")
        .param(&Unsound::size, "size", "too small by itself", velum::above(0.0))
        .param(&Unsound::count, "size", "named like the one before");
  }
  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context&) const { return cloud; }
};

}  // namespace
VELUM_STAGE(Unsound)
