// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <catch2/catch.hpp>
#include <functional>
#include <map>
#include <string>
#include <velum/testing.hpp>

#include "registration/test_surfaces.hpp"

namespace velum::registration::test {

/// A library's registration as a stage, with settings under which it registers bumpy() (1 m across)
/// from a few degrees off to `accuracy` [m].
struct LibraryStage {
  std::string id;
  std::map<std::string, std::string> settings;
  double accuracy;

  [[nodiscard]] velum::test::Stage stage() const {
    velum::test::Stage made(id);
    for (const auto& [name, value] : settings) made.set(name, value);
    return made;
  }
};

inline Transform as_transform(const Pose& pose) {
  Transform transform;
  transform.matrix = pose;
  return transform;
}

inline const Pose& found(const velum::test::Outcome& outcome) {
  return outcome.get<Transform>().matrix;
}

/// Another sample of the surface comes back, and what is given out agrees with itself.
inline void finds_a_known_motion(const LibraryStage& library) {
  const Cloud target = bumpy(3000, 1);
  const Pose truth = turned(4.0, {0.02, -0.01, 0.01});
  const Cloud source = bumpy(2500, 2).transformed(truth.inverse());
  const auto outcome = library.stage().run(source, target);
  const auto miss = geometry::difference(found(outcome), truth);
  INFO(miss.rotation / kDegree << " deg, " << miss.translation << " m");
  CHECK(miss.rotation < 2.0 * library.accuracy);
  CHECK(miss.translation < library.accuracy);
  CHECK(outcome.measure("overlap") == 1.0);
  CHECK(outcome.get<Transform>().fitness == outcome.measure("fitness"));
  CHECK(outcome.measure("rmse") == Approx(std::sqrt(outcome.measure("fitness"))));
  const Eigen::Vector3d expected =
      found(outcome) * (source.origin() + source.positions().col(7).cast<double>());
  CHECK((outcome.cloud().origin() + outcome.cloud().positions().col(7).cast<double>() - expected)
            .norm() < 1e-6);
  CHECK(outcome.cloud().has(column::kNormals));
  const auto& table = outcome.get<Table>();
  REQUIRE(table.size() == static_cast<std::size_t>(outcome.measure("iterations")));
  const Eigen::Vector3d centre =
      outcome.cloud().origin() + outcome.cloud().positions().cast<double>().rowwise().mean();
  CHECK(table.number(table.size() - 1, "x") == Approx(centre.x()).margin(1e-5));
  CHECK(table.number(table.size() - 1, "z") == Approx(centre.z()).margin(1e-5));
}

/// The start may be anywhere, and so may the clouds: far coordinates lose nothing.
inline void starts_where_it_is_told(const LibraryStage& library) {
  Pose there = Pose::Identity();
  there.translation() << 4e5, 5e6, 100.0;
  const auto brought = [&](const Cloud& cloud) {
    return Cloud(Points(cloud.positions()), there.translation())
        .with(column::kNormals, cloud.column(column::kNormals));
  };
  const Pose truth = there * turned(120.0, {3.0, 2.0, 0.0}) * there.inverse();
  const Pose off = there * turned(3.0, {0.01, 0.0, 0.01}) * there.inverse();
  const auto outcome = library.stage().run(brought(bumpy(2500, 2)).transformed(truth.inverse()),
                                           brought(bumpy(3000, 1)), as_transform(off * truth));
  const auto miss =
      geometry::difference(found(outcome), truth, truth.inverse() * there.translation());
  INFO(miss.rotation / kDegree << " deg, " << miss.translation << " m");
  CHECK(miss.rotation < 2.0 * library.accuracy);
  CHECK(miss.translation < library.accuracy);
}

/// From 120 degrees it comes to rest elsewhere, and the measures show it (thesis table 3.11).
inline void far_start_shows(const LibraryStage& library) {
  const Cloud target = bumpy(2000, 1);
  const auto near = library.stage().run(bumpy(1500, 2), target);
  const auto far =
      library.stage().run(bumpy(1500, 2).transformed(turned(120.0, {0.1, 0.1, 0})), target);
  CHECK(far.measure("rmse") > 1.3 * near.measure("rmse"));
}

inline void refuses_too_few(const LibraryStage& library) {
  const Cloud target = bumpy(500, 1);
  const std::vector<std::int32_t> two{0, 1};
  CHECK_THROWS_WITH(library.stage().run(target.select(two), target),
                    Catch::Contains("the source has 2 points"));
  CHECK_THROWS_WITH(library.stage().run(target, target.select(two)),
                    Catch::Contains("the target has 2 points"));
}

/// Nothing near enough is an error, not a result.
inline void refuses_clouds_apart(const LibraryStage& library) {
  const Cloud target = bumpy(800, 1);
  CHECK_THROWS_AS(library.stage()
                      .set("max_distance", "0.1 m")
                      .run(target.transformed(turned(0.0, {50, 0, 0})), target),
                  Error);
}

inline void says_when_it_did_not_settle(const LibraryStage& library) {
  const Cloud target = bumpy(1500, 1);
  const auto outcome = library.stage()
                           .set("iterations", "1")
                           .run(bumpy(1500, 2).transformed(turned(6.0, {0.03, 0.02, 0})), target);
  CHECK(outcome.measure("iterations") == 1.0);
  REQUIRE_FALSE(outcome.warnings.empty());
  CHECK_THAT(outcome.warnings[0], Catch::Contains("ended after 1 iterations"));
}

inline void ends_when_interrupted(const LibraryStage& library) {
  const Cloud target = bumpy(1000, 1);
  CHECK_THROWS(library.stage().cancelled().run(target, target));
}

inline void keeps_the_promises(const LibraryStage& library) {
  for (const auto& fault : velum::test::conformance(library.id, library.settings))
    FAIL_CHECK(fault);
}

}  // namespace velum::registration::test
