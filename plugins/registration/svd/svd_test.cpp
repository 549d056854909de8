// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Points;
using velum::test::Stage;

namespace {

/// The thesis's test: 45 degrees about y (table 3.1), here with a shift.
velum::Pose truth() {
  velum::Pose pose = velum::Pose::Identity();
  pose.linear() =
      Eigen::AngleAxisd(std::numbers::pi / 4, Eigen::Vector3d::UnitY()).toRotationMatrix();
  pose.translation() << 1.0, -2.0, 0.5;
  return pose;
}

const std::vector<Eigen::Vector3d> kCorners{{0, 0, 0}, {10, 0, 0}, {10, 8, 0}, {4, 3, 5}};

std::string toml(const Eigen::Vector3d& p) {
  return fmt::format("[\"{} m\", \"{} m\", \"{} m\"]", p.x(), p.y(), p.z());
}

std::string rows(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to) {
  std::string all = "[";
  for (std::size_t i = 0; i < from.size(); ++i)
    all += fmt::format("{{ source = {}, target = {} }},", toml(from[i]), toml(to[i]));
  return all + "]";
}

std::vector<Eigen::Vector3d> moved(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3d> there;
  for (const auto& p : points) there.push_back(truth() * p);
  return there;
}

const Cloud& some() {
  static const Cloud cloud(Points(Points::Random(3, 50)));
  return cloud;
}

velum::test::Outcome run(const std::string& pairs) {
  return Stage("registration.svd").set("pairs", pairs).run(some());
}

struct TemporaryFile {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("velum-svd-{}.txt", ::getpid());
  explicit TemporaryFile(const std::string& text) { std::ofstream(path) << text; }
  ~TemporaryFile() { std::filesystem::remove(path); }
};

}  // namespace

TEST_CASE("exact picks give the exact motion") {
  const auto outcome = run(rows(kCorners, moved(kCorners)));
  const auto& found = outcome.get<velum::Transform>();
  CHECK(found.matrix.isApprox(truth(), 1e-12));
  CHECK(outcome.measure("rmse") < 1e-12);
  const Eigen::Vector3d p =
      outcome.cloud().origin() + outcome.cloud().positions().col(7).cast<double>();
  CHECK((p - truth() * some().positions().col(7).cast<double>()).norm() < 1e-5);
  CHECK(outcome.warnings.empty());
}

TEST_CASE("the residual of each pair is in the table, and the bad one stands out") {
  auto target = moved(kCorners);
  target[2] += Eigen::Vector3d(0.0, 0.3, 0.0);
  const auto outcome = run(rows(kCorners, target));
  const auto& table = outcome.get<velum::Table>();
  REQUIRE(table.size() == 4);
  double squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i) squares += std::pow(table.number(i, "residual"), 2);
  CHECK(std::sqrt(squares / 4.0) == Approx(outcome.measure("rmse")));
  CHECK(table.number(2, "residual") > 0.02);
}

TEST_CASE("noise on the picks moves the result by about as much (thesis table 3.2)") {
  velum::Random random(4);
  auto target = moved(kCorners);
  for (auto& p : target)
    for (int k = 0; k < 3; ++k) p[k] += 0.05 * random.gaussian();
  const auto found = run(rows(kCorners, target)).get<velum::Transform>();
  CHECK((found.matrix.linear() - truth().linear()).norm() < 0.03);
  CHECK((found.matrix.translation() - truth().translation()).norm() < 0.3);
}

TEST_CASE("too few picks, picks on a line and doubled picks are refused with the reason") {
  const auto refused = [](const std::vector<Eigen::Vector3d>& picks, const char* words) {
    CHECK_THROWS_WITH(run(rows(picks, moved(picks))), Catch::Contains(words));
  };
  refused({{0, 0, 0}, {1, 0, 0}}, "2 pairs are given");
  refused({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, "on a line");
  refused({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, "name the same point");
  CHECK_THROWS_WITH(Stage("registration.svd").run(some()), Catch::Contains("0 pairs"));
}

TEST_CASE("picks close to a line are said to be") {
  const std::vector<Eigen::Vector3d> picks{{0, 0, 0}, {5, 0.01, 0}, {10, 0, 0}};
  const auto outcome = run(rows(picks, moved(picks)));
  REQUIRE(outcome.warnings.size() == 1);
  CHECK_THAT(outcome.warnings[0], Catch::Contains("close to a line"));
  CHECK(outcome.measure("spread") < 0.01);
}

TEST_CASE("pairs from a file, in its own units, with a heading and comments") {
  const TemporaryFile file(
      "xs ys zs xt yt zt\n# four corners\n0,0,0,1000,0,0\r\n1000 0 0 2000 0 0\n\n"
      "0;1000;0;1000;1000;0\n0\t0\t1000\t1000\t0\t1000");
  const auto outcome =
      Stage("registration.svd").set("file", file.path.string()).set("units", "mm").run(some());
  CHECK(outcome.get<velum::Transform>().matrix.translation().isApprox(Eigen::Vector3d(1, 0, 0)));
  CHECK(outcome.measure("pairs") == 4.0);
}

TEST_CASE("a bad file is refused with its line") {
  for (const auto& [text, words] :
       {std::pair("0 0 0 1 1 1\n0 0 0 1 1\n", "found 5 numbers"),
        std::pair("0 0 0 1 1 1\n0 0 0 1 1 x\n", "no finite number"),
        std::pair("0 0 0 1 1 1\n0 0 0 1 1 nan\n", "no finite number")}) {
    const TemporaryFile file(text);
    Stage stage("registration.svd");
    stage.set("file", file.path.string());
    try {
      stage.run(some());
      FAIL_CHECK("accepted");
    } catch (const velum::Error& error) {
      CHECK_THAT(error.what(), Catch::Contains(words));
      CHECK_THAT(error.where(), Catch::EndsWith(":2"));
      CHECK(error.fault() == velum::Fault::input);
    }
  }
}

TEST_CASE("pairs given twice are refused") {
  const TemporaryFile file("0 0 0 1 1 1\n");
  CHECK_THROWS_WITH(Stage("registration.svd")
                        .set("file", file.path.string())
                        .set("pairs", rows(kCorners, kCorners))
                        .run(some()),
                    Catch::Contains("given twice"));
}

TEST_CASE("registering by picks keeps to the promises of every stage") {
  for (const auto& fault :
       velum::test::conformance("registration.svd", {{"pairs", rows(kCorners, moved(kCorners))}}))
    FAIL_CHECK(fault);
}
