// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <optional>

#include "test_trials.hpp"

using namespace velum::registration::test;
using velum::Cloud;
using velum::Pose;
using velum::test::Outcome;
using velum::test::Stage;

namespace {

void all_right(const std::optional<Pair>& pair, std::uint64_t trials) {
  if (!pair) {
    WARN("skipped: no shared data");
    return;
  }
  for (std::uint64_t seed = 1; seed <= trials; ++seed) {
    const Trial one = trial(*pair, random_frame(*pair, seed));
    INFO("start " << seed << ": " << one.text);
    CHECK(one.right);
  }
}

}  // namespace

TEST_CASE("120 degrees about Z and an offset of (30, 20), which defeats ICP (thesis table 3.11)") {
  Pose frame = Pose::Identity();
  frame.linear() = Eigen::AngleAxisd(120.0 * kDegree, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  frame.translation() << 30.0, 20.0, 0.0;
  const Trial one = trial(whole(), frame);
  INFO(one.text);
  CHECK(one.right);
}

TEST_CASE("a part of the scene, far away (thesis table 3.21)") {
  all_right(part(), 2);
}

TEST_CASE("parts that were sampled apart and share a third of the source") {
  all_right(corner(), 2);
}

TEST_CASE("bunny scans 000 and 045 from any orientation") {
  all_right(bunny_pair("000", "045"), 1);
}

TEST_CASE("bunny scans 000 and 090 from any orientation") {
  all_right(bunny_pair("000", "090"), 1);
}

TEST_CASE("bunny scans 045 and 090 from any orientation") {
  all_right(bunny_pair("045", "090"), 1);
}

TEST_CASE("a street from any orientation") {
  all_right(street_pair(), 1);
}

TEST_CASE("a kitchen from any orientation") {
  all_right(kitchen_pair(), 1);
}

TEST_CASE("the wind tunnel from any orientation, though it fits itself when turned") {
  all_right(tunnel(), 3);
}

TEST_CASE("a strip that hardly fixes the turn is registered or refused, never put wrong") {
  const Pair pair = strip();
  for (std::uint64_t seed = 2; seed <= 4; ++seed) {
    const Trial one = trial(pair, random_frame(pair, seed));
    INFO("start " << seed << ": " << one.text);
    CHECK((one.right || one.refused));
  }
}

TEST_CASE("the cloud given back lies on the target, columns with it, whatever the origin") {
  const Cloud target = shapes(1).with_origin(Eigen::Vector3d::Zero());
  const Cloud source =
      Cloud(target.position_column(), Eigen::Vector3d(4e5, 5e6, 100.0))
          .with("intensity", velum::Column(Eigen::VectorXf::Ones(target.size()).eval()));
  const Outcome outcome = Stage("registration.global").run(source, target);
  CHECK(outcome.cloud().has("intensity"));
  const Eigen::Vector3d p =
      outcome.cloud().origin() + outcome.cloud().positions().col(7).cast<double>();
  CHECK((p - target.positions().col(7).cast<double>()).norm() < 0.1);
  CHECK(static_cast<double>(outcome.get<velum::Table>().size()) == outcome.measure("iterations"));
}

TEST_CASE("registering globally keeps to the promises of every stage") {
  for (const auto& fault : velum::test::conformance("registration.global")) FAIL_CHECK(fault);
}
