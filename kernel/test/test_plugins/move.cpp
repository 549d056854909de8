// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Moves points: the plainest stage, with a relative length.
#include <velum/stage.hpp>

namespace {

struct Move {
  velum::Length by = 0.1;
  bool talk = false;

  static auto about() {
    return velum::About<Move>("Moves all points along x.")
        .in("cloud")
        .out("cloud")
        .param(&Move::by, "by", "how far", velum::between(0.0, 10.0))
        .param(&Move::talk, "talk", "warns and informs");
  }

  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    velum::Points points = cloud.positions();
    points.row(0).array() += static_cast<float>(by);
    context.measure("by", by, "m", velum::Better::lower);
    if (talk) {
      context.warn("moved");
      context.info("by much");
    }
    return cloud.with_positions(std::move(points));
  }
};

}  // namespace
VELUM_STAGE(Move)
