// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "border/border_points.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "registration/test_context.hpp"

using velum::Cloud;
using velum::Index;
using velum::Points;

namespace {

// A sheet of 30 × 30 points, `stretch` times farther apart in y than in x, with noise in z.
Cloud sheet(double stretch, double noise) {
  velum::Random random(3);
  Points points(3, 900);
  for (Index i = 0; i < 900; ++i)
    points.col(i) =
        Eigen::Vector3d(0.02 * static_cast<double>(i % 30),
                        0.02 * stretch * static_cast<double>(i / 30), noise * random.gaussian())
            .cast<float>();
  return Cloud(std::move(points));
}

bool on_rim(Index i) {
  return i % 30 == 0 || i % 30 == 29 || i / 30 == 0 || i / 30 == 29;
}

}  // namespace

TEST_CASE("the rim of an even sheet is its border, and nothing else is") {
  velum::test::PlainContext context;
  for (const double noise : {0.0, 0.003}) {
    const auto border = velum::border::border_points(sheet(1.0, noise), context);
    for (Index i = 0; i < 900; ++i) CHECK((border[static_cast<std::size_t>(i)] != 0) == on_rim(i));
  }
}

TEST_CASE("lines three beams apart do not make a border inside") {
  velum::test::PlainContext context;
  const auto border = velum::border::border_points(sheet(3.0, 0.0), context);
  for (Index i = 0; i < 900; ++i) CHECK((border[static_cast<std::size_t>(i)] != 0) == on_rim(i));
}

TEST_CASE("the rim of a hole is border") {
  velum::test::PlainContext context;
  const Cloud whole = sheet(1.0, 0.0);
  std::vector<std::int32_t> kept;
  const Eigen::Vector2f middle(0.29F, 0.29F);
  for (Index i = 0; i < 900; ++i)
    if ((whole.positions().col(i).head<2>() - middle).norm() > 0.1F)
      kept.push_back(static_cast<std::int32_t>(i));
  const Cloud holed = whole.select(kept);
  const auto border = velum::border::border_points(holed, context);
  int rim = 0;
  for (Index i = 0; i < holed.size(); ++i) {
    const float r = (holed.positions().col(i).head<2>() - middle).norm();
    if (r < 0.2F && border[static_cast<std::size_t>(i)] != 0) {
      CHECK(r < 0.13F);
      ++rim;
    }
  }
  CHECK(rim > 12);
}

TEST_CASE("gaps around a place") {
  Points points(3, 4);
  points << 1, 0, -1, 0, 0, 1, 0, -1, 0, 0, 0, 0;
  const velum::ConstPoints view(points.data(), 3, 4);
  const std::vector<velum::Neighbour> all{{0, 1}, {1, 1}, {2, 1}, {3, 1}};
  const auto gap = [&](std::size_t count) {
    return velum::border::largest_gap(view, Eigen::Vector3f::Zero(), Eigen::Vector3d::UnitZ(),
                                      std::span(all).first(count));
  };
  CHECK(gap(4) == Approx(std::numbers::pi / 2));
  CHECK(gap(3) == Approx(std::numbers::pi));
  CHECK(gap(2) == Approx(1.5 * std::numbers::pi));
  CHECK(gap(1) == Approx(2.0 * std::numbers::pi));
}

TEST_CASE("a handful of points is all border") {
  velum::test::PlainContext context;
  for (const Index n : {0, 1, 2, 3}) {
    Points points = Points::Random(3, n);
    const auto border = velum::border::border_points(Cloud(points), context);
    REQUIRE(border.size() == static_cast<std::size_t>(n));
    for (const auto one : border) CHECK(one == 1);
  }
}
