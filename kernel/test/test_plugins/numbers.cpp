// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Random points: the same for the same seed.
#include <velum/stage.hpp>

namespace {

struct Numbers {
  int count = 100;
  double origin = 0.0;

  static auto about() {
    return velum::About<Numbers>("Random points in the unit cube.")
        .out("cloud")
        .param(&Numbers::count, "count", "how many", velum::between(0, 1e8))
        .param(&Numbers::origin, "origin", "of the cloud, on all axes", velum::anything())
        .seeded();
  }

  velum::Cloud operator()(velum::Context& context) const {
    velum::Random random = context.random();
    velum::Points points(3, count);
    for (velum::Index i = 0; i < points.size(); ++i)
      points.data()[i] = static_cast<float>(random.uniform());
    context.measure("count", count, "");
    return velum::Cloud(std::move(points), Eigen::Vector3d::Constant(origin));
  }
};

}  // namespace
VELUM_STAGE(Numbers)
