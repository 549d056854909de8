// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <velum/random.hpp>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Column;
using velum::Index;
using velum::Table;
using velum::test::Outcome;
using velum::test::Stage;

namespace {

struct Reading {
  double range;
  int beam = 0;
  double time = 0.0;
  int label = 1;
};

// Beam b looks 10 degrees further to the left than beam b - 1, beam 0 along x.
Cloud cloud_of(const std::vector<Reading>& readings) {
  const auto n = static_cast<Index>(readings.size());
  velum::Points positions(3, n);
  Eigen::VectorXi beam(n);
  Eigen::VectorXi label(n);
  Eigen::VectorXd time(n);
  for (Index i = 0; i < n; ++i) {
    const Reading& one = readings[static_cast<std::size_t>(i)];
    const double angle = one.beam * 3.14159265358979 / 18.0;
    positions.col(i) << static_cast<float>(one.range * std::cos(angle)),
        static_cast<float>(one.range * std::sin(angle)), 0.0F;
    beam[i] = one.beam;
    label[i] = one.label;
    time[i] = one.time;
  }
  return Cloud(std::move(positions))
      .with("beam", Column(std::move(beam)))
      .with("label", Column(std::move(label)))
      .with("time", Column(std::move(time)))
      .with_sensors({{"scanner", velum::Pose::Identity()}});
}

std::vector<Reading> normal_readings(double mean, int count, double drift_per_second = 0.0) {
  velum::Random random(11);
  std::vector<Reading> readings;
  for (int i = 0; i < count; ++i)
    readings.push_back({mean + 0.004 * random.gaussian() + drift_per_second * i, 0, 1.0 * i});
  return readings;
}

Stage statistics() {
  return Stage("analysis.range_statistics");
}
const Table& table_of(const Outcome& outcome) {
  return std::get<Table>(*outcome.results.at(0));
}
const Table& histogram_of(const Outcome& outcome) {
  return std::get<Table>(*outcome.results.at(1));
}

}  // namespace

TEST_CASE("mean and spread of readings counted by hand") {
  const auto outcome = statistics().run(cloud_of({{1.998}, {2.000}, {2.002}, {2.004}}));
  const Table& table = table_of(outcome);
  REQUIRE(table.size() == 1);
  CHECK(table.number(0, "readings") == 4.0);
  CHECK(table.number(0, "mean") == Approx(2001.0).margin(1e-3));
  CHECK(table.number(0, "deviation") == Approx(std::sqrt(20.0 / 3.0)).margin(1e-3));
  CHECK(table.number(0, "greatest") == Approx(2004.0).margin(1e-3));
  CHECK(std::get<std::string>(table.at(0, "normality_p")).empty());  // four readings say nothing
  CHECK(std::get<std::string>(table.at(0, "error")).empty());        // no reference
}

TEST_CASE("the error against a reference distance, in lengths and shares") {
  const auto outcome =
      statistics().set("reference", "2 m").run(cloud_of({{2.004}, {2.006}, {2.005}}));
  CHECK(outcome.measure("error") == Approx(0.005).margin(1e-6));
  CHECK(outcome.measure("error_share") == Approx(0.0025).margin(1e-6));
  CHECK(table_of(outcome).number(0, "error_share") == Approx(0.25).margin(1e-3));
}

TEST_CASE("normal readings are found normal, a mixture is not") {
  const auto normal = statistics().run(cloud_of(normal_readings(3.0, 2000)));
  CHECK(normal.measure("normality_p") > 0.01);
  CHECK(normal.measure("deviation") == Approx(0.004).epsilon(0.05));
  auto mixed = normal_readings(3.0, 2000);
  for (std::size_t i = 0; i < 40; ++i) mixed[50 * i].range += 0.03;
  CHECK(statistics().run(cloud_of(mixed)).measure("normality_p") < 1e-6);
}

TEST_CASE("a drift is found with its size, and none where there is none") {
  const auto still = statistics().run(cloud_of(normal_readings(3.0, 4000)));
  CHECK(still.measure("drift_p") > 0.01);
  const auto moving = statistics().run(cloud_of(normal_readings(3.0, 4000, 1e-6)));
  CHECK(moving.measure("drift") == Approx(1e-6).epsilon(0.2));
  CHECK(moving.measure("drift_p") < 1e-6);
  CHECK(table_of(moving).number(0, "drift") == Approx(3.6).epsilon(0.2));
}

TEST_CASE("every beam has its own row and its angle") {
  const auto outcome = statistics()
                           .set("per", "beam")
                           .run(cloud_of({{2.0, 0}, {2.002, 0}, {3.0, 9}, {3.006, 9}, {4.0, 18}}));
  const Table& table = table_of(outcome);
  REQUIRE(table.size() == 3);
  CHECK(table.number(1, "beam") == 9.0);
  CHECK(table.number(1, "angle") == Approx(90.0).margin(1e-3));
  CHECK(table.number(1, "mean") == Approx(3003.0).margin(1e-3));
  CHECK(table.number(2, "angle") == Approx(180.0).margin(1e-3));
  CHECK(outcome.measure("groups") == 3.0);
  CHECK(outcome.measure("least_mean") == Approx(2.001).margin(1e-5));
  CHECK(outcome.measure("greatest_mean") == Approx(4.0).margin(1e-5));
}

TEST_CASE("every period has its own row") {
  const auto outcome = statistics()
                           .set("per", "period")
                           .set("period", "1 h")
                           .run(cloud_of({{2.0, 0, 100.0},
                                          {2.001, 0, 3699.0},
                                          {3.0, 0, 3701.0},
                                          {4.0, 0, 100.0 + 2.5 * 3600.0}}));
  const Table& table = table_of(outcome);
  REQUIRE(table.size() == 3);
  CHECK(table.number(0, "period") == 1.0);
  CHECK(table.number(0, "readings") == 2.0);
  CHECK(table.number(2, "period") == 3.0);
}

TEST_CASE("the perpendicular beam is the one with the least mean range") {
  const Cloud cloud = cloud_of({{2.1, 8},
                                {2.1, 8},
                                {2.1, 8},
                                {2.0, 9},
                                {2.01, 9},
                                {2.1, 10},
                                {2.1, 10},
                                {1.9, 12},  // too few readings to be the target's
                                {0.5, 13},  // something before the target
                                {0.5, 13}});
  const auto any = statistics().set("perpendicular", "true").run(cloud);
  CHECK(table_of(any).number(0, "mean") == Approx(500.0).margin(1e-3));
  const auto target = statistics().set("perpendicular", "true").set("nearest", "1 m").run(cloud);
  CHECK(table_of(target).number(0, "mean") == Approx(2005.0).margin(1e-3));
}

TEST_CASE("readings are chosen by beam, label and range") {
  const Cloud cloud =
      cloud_of({{2.0, 1, 0.0, 5}, {2.1, 2, 0.0, 5}, {2.2, 2, 0.0, 6}, {7.0, 2, 0.0, 5}});
  CHECK(statistics().set("beams", "[2]").run(cloud).measure("readings") == 3.0);
  CHECK(statistics().set("labels", "[5]").run(cloud).measure("readings") == 3.0);
  CHECK(statistics().set("farthest", "5 m").run(cloud).measure("readings") == 3.0);
  CHECK_THROWS_AS(statistics().set("beams", "[7]").run(cloud), velum::Error);
}

TEST_CASE("the histogram counts every reading once, beside what a normal one would have") {
  const auto outcome = statistics().set("bin", "2 mm").run(cloud_of(normal_readings(3.0, 5000)));
  const Table& bins = histogram_of(outcome);
  double counted = 0.0;
  double normal = 0.0;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    counted += bins.number(i, "readings");
    normal += bins.number(i, "normal");
    CHECK(std::abs(std::remainder(bins.number(i, "from"), 2.0)) < 1e-6);
    CHECK(std::abs(bins.number(i, "readings") - bins.number(i, "normal")) < 150.0);
  }
  CHECK(counted == 5000.0);
  CHECK(normal == Approx(5000.0).epsilon(0.002));
  CHECK_THROWS_AS(statistics().set("bin", "1e-9 m").run(cloud_of({{1.0}, {2.0}})), velum::Error);
}

TEST_CASE("ranges are from where the scanner stands, wherever the cloud has been moved") {
  const Cloud cloud = cloud_of(normal_readings(3.0, 100));
  velum::Pose moved = velum::Pose::Identity();
  moved.translation() << 100.0, 20.0, -3.0;
  moved.linear() = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const auto before = statistics().run(cloud);
  const auto after = statistics().run(cloud.transformed(moved));
  CHECK(after.measure("mean") == Approx(before.measure("mean")).margin(1e-5));
  CHECK(table_of(after).number(0, "angle") == Approx(0.0).margin(1e-3));
}

TEST_CASE("a cloud without a scanner, or without times for periods, is refused") {
  CHECK_THROWS_AS(statistics().run(cloud_of({{2.0}}).with_sensors({})), velum::Error);
  CHECK_THROWS_AS(statistics().set("per", "period").run(cloud_of({{2.0}}).without("time")),
                  velum::Error);
}

TEST_CASE("analysis.range_statistics keeps the promises of every stage") {
  for (const auto& fault : velum::test::conformance("analysis.range_statistics")) FAIL_CHECK(fault);
}
