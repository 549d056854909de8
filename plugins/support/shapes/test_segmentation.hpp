// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>
#include <velum/testing.hpp>

#include "shapes/test_hand_labels.hpp"
#include "shapes/test_scene.hpp"

/// What every segmentation promises, checked on the stage that a test gives, with its settings.
namespace velum::test {

/// The scene of shapes with 4 mm of noise.
inline const Cloud& noisy_shapes() {
  static const Cloud cloud = shapes_scene("4 mm");
  return cloud;
}

/// side×side points 10 mm apart that start at `corner`, in the plane z = corner.z.
inline Points flat_patch(Index side, const Eigen::Vector3f& corner = Eigen::Vector3f::Zero()) {
  Points points(3, side * side);
  for (Index i = 0; i < points.cols(); ++i)
    points.col(i) = corner + 0.01F * Eigen::Vector3f(static_cast<float>(i % side),
                                                     static_cast<float>(i / side), 0.0F);
  return points;
}

inline Cloud with_normals(const Cloud& cloud, int neighbours = 9) {
  return Stage("features.normals").set("neighbours", neighbours).run(cloud).cloud();
}

/// Labels, table and measures tell the same, the largest cluster first.
inline void labels_agree(const Outcome& outcome) {
  const auto& found = outcome.get<Clusters>();
  const auto label = found.label();
  REQUIRE(found.kinds.size() > 0);
  for (std::size_t r = 0; r < found.kinds.size(); ++r) {
    CHECK(found.kinds.number(r, "cluster") == static_cast<double>(r));
    CHECK((label.array() == static_cast<int>(r)).count() ==
          static_cast<Index>(found.kinds.number(r, "points")));
    if (r > 0) CHECK(found.kinds.number(r, "points") <= found.kinds.number(r - 1, "points"));
  }
  CHECK(label.maxCoeff() == static_cast<int>(found.kinds.size()) - 1);
  const auto assigned = static_cast<double>((label.array() >= 0).count());
  CHECK(outcome.measure("assigned") == Approx(assigned / static_cast<double>(label.size())));
  CHECK(outcome.measure("clusters") == static_cast<double>(found.kinds.size()));
}

/// A stage that finds something among the noisy shapes, but nothing of `too_many` points.
inline void keeps_promises(const Stage& stage, const char* too_many = "20000") {
  SECTION("labels and the table agree, the largest first") {
    labels_agree(Stage(stage).run(noisy_shapes()));
  }
  SECTION("nothing large enough leaves nothing, with a warning") {
    const Outcome outcome = Stage(stage).set("min_size", too_many).run(noisy_shapes());
    CHECK(outcome.get<Clusters>().kinds.empty());
    CHECK(outcome.get<Clusters>().label().maxCoeff() == -1);
    REQUIRE(outcome.warnings.size() == 1);
    CHECK(outcome.warnings.front().find("min_size") != std::string::npos);
  }
  SECTION("cancelled before it starts it does not run") {
    CHECK_THROWS_AS(Stage(stage).cancelled().run(noisy_shapes()), Cancelled);
  }
}

/// The promises of a stage that works with normals.
inline void keeps_promises_with_normals(const Stage& stage) {
  keeps_promises(stage);
  SECTION("a cloud without normals is refused") {
    CHECK_THROWS_AS(Stage(stage).run(Cloud(flat_patch(10))), Error);
  }
}

/// A flat patch of 40×40 points is one cluster, and its row in the table tells it.
inline void describes_a_patch(const Stage& stage) {
  const Outcome outcome = Stage(stage).run(with_normals(Cloud(flat_patch(40))));
  const auto& kinds = outcome.get<Clusters>().kinds;
  REQUIRE(kinds.size() == 1);
  CHECK(kinds.number(0, "points") > 1500.0);
  CHECK(std::abs(kinds.number(0, "axis_z")) == Approx(1.0));
  CHECK(kinds.number(0, "rms") < 1e-4);
  CHECK(kinds.number(0, "length") == Approx(0.39).epsilon(0.05));
}

inline void repeats_with_its_seed(const Stage& stage) {
  const auto labels = [&](std::uint64_t seed) {
    return Eigen::VectorXi(Stage(stage).seed(seed).run(noisy_shapes()).get<Clusters>().label());
  };
  CHECK(labels(3) == labels(3));
}

/// The table under objects that people labelled (mOSD) is one cluster.
inline void finds_the_tabletop(const Stage& stage) {
  for (const std::string name : {"learn0", "learn36"}) {
    const auto scan = tabletop(name);
    if (!scan) {
      WARN("skipped: VELUM_SHARED has no mOSD");
      return;
    }
    const Outcome outcome = Stage(stage).run(joined_labels(*scan, 1, 9, 1));
    const Score table = score(outcome.get<Clusters>(), 1);
    INFO(name << " recall " << table.recall() << " precision " << table.precision());
    CHECK(table.iou() > 0.95);
  }
}

/// What a README says that a stage finds of something labelled by hand.
struct Figure {
  const char* scan;
  double recall;
  double precision;
};

/// Ground seen from the air (ISPRS) is found to within 5 % of what the README says.
inline void finds_the_ground(const Stage& stage, const std::vector<Figure>& figures) {
  for (const Figure& figure : figures) {
    const auto scan = terrain(figure.scan);
    if (!scan) {
      WARN("skipped: VELUM_SHARED has no ISPRS scans");
      return;
    }
    const Score found = score(Stage(stage).run(*scan).get<Clusters>(), 1);
    INFO(figure.scan);
    CHECK(found.recall() == Approx(figure.recall).margin(0.05).epsilon(0.0));
    CHECK(found.precision() == Approx(figure.precision).margin(0.05).epsilon(0.0));
  }
}

}  // namespace velum::test
