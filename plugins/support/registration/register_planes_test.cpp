// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/register_planes.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "registration/test_context.hpp"
#include "registration/test_room.hpp"

using namespace velum;
using namespace velum::registration;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

const Pose kFirst = test::looking({-3.2, 2.2, 1.0}, {-0.3, 0.0, 1.5});
const Pose kSecond = test::looking({3.0, 2.6, 0.9}, {0.3, 0.0, 1.5});

/// Registers the two scans after turning the source's frame any way.
geometry::Difference miss(const test::Room& room, std::uint64_t seed, Context& context,
                          PlanesResult* out = nullptr) {
  Random random(seed);
  const Pose frame = test::random_pose(random, 5.0);
  const Cloud source = room.scan(kFirst, 0.5 * kDegree, 0.004, 2 * seed + 1).transformed(frame);
  const Cloud target = room.scan(kSecond, 0.5 * kDegree, 0.004, 2 * seed + 2);
  const PlanesResult result = register_planes(source, target, {}, context);
  if (out != nullptr) *out = result;
  const Pose truth = kSecond.inverse() * kFirst * frame.inverse();
  const Pose found = geometry::to_true(result.pose, source.origin(), target.origin());
  return geometry::difference(found, truth, frame * Eigen::Vector3d(3.0, 0.0, 0.0));
}

}  // namespace

TEST_CASE("a closed room is registered from any orientation") {
  test::PlainContext context(2);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PlanesResult result;
    const auto error = miss(test::Room::tunnel(true), seed, context, &result);
    INFO("seed " << seed << ", " << result.matched << " planes, gap " << result.gap);
    CHECK(error.rotation < 0.05 * kDegree);
    CHECK(error.translation < 2e-3);
  }
}

TEST_CASE("in an open tunnel what stands in it fixes the place along it") {
  test::PlainContext context(2);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PlanesResult result;
    const auto error = miss(test::Room::tunnel(false), seed, context, &result);
    INFO("seed " << seed << ", " << result.matched << " planes, gap " << result.gap);
    CHECK(error.rotation < 0.05 * kDegree);
    CHECK(error.translation < 2e-3);
    CHECK(result.deviations.translation < 2e-3);
  }
}
