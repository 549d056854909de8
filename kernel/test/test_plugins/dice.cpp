// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Another result each time.
#include <chrono>
#include <velum/stage.hpp>

namespace {

struct Dice {
  static auto about() {
    return velum::About<Dice>("A point nobody can foresee.").out("cloud").nondeterministic();
  }
  velum::Cloud operator()(velum::Context&) const {
    velum::Points point(3, 1);
    point.setConstant(static_cast<float>(
        std::chrono::steady_clock::now().time_since_epoch().count() % 1'000'003));
    return velum::Cloud(std::move(point));
  }
};

}  // namespace
VELUM_STAGE(Dice)
