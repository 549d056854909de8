// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Clusters;
using velum::Index;
using velum::Points;
using velum::test::Outcome;
using velum::test::Stage;

namespace {

Cloud labelled(const std::vector<int>& labels) {
  const auto count = static_cast<Index>(labels.size());
  return Cloud(Points(Points::Random(3, count)))
      .with("label", velum::Column(
                         Eigen::VectorXi(Eigen::Map<const Eigen::VectorXi>(labels.data(), count))));
}

Clusters clusters(const std::vector<int>& truth, const std::vector<int>& found) {
  const auto count = static_cast<Index>(found.size());
  velum::Table kinds({{"cluster", ""}, {"points", ""}});
  const int most = *std::max_element(found.begin(), found.end());
  for (int i = 0; i <= most; ++i)
    kinds.add({std::int64_t{i}, std::int64_t{std::count(found.begin(), found.end(), i)}});
  return {labelled(truth),
          velum::Column(Eigen::VectorXi(Eigen::Map<const Eigen::VectorXi>(found.data(), count))),
          kinds};
}

Stage stage(const char* label) {
  Stage made("analysis.segmentation_score");
  made.set("label", label);
  return made;
}

// Six points of the object 7, four of others; cluster 0 has four of the six and one other.
Clusters example() {
  return clusters({7, 7, 7, 7, 7, 7, 1, 1, 2, 2}, {0, 0, 0, 0, 1, -1, 0, 1, 1, -1});
}

}  // namespace

TEST_CASE("the best cluster is judged by precision, recall and IoU") {
  const Outcome outcome = stage("[7]").run(example());
  CHECK(outcome.measure("cluster") == 0.0);
  CHECK(outcome.measure("precision") == Approx(4.0 / 5.0));
  CHECK(outcome.measure("recall") == Approx(4.0 / 6.0));
  CHECK(outcome.measure("iou") == Approx(4.0 / 7.0));
}

TEST_CASE("as the thesis counts, wrong points make up for missing ones") {
  // Five found for six: 1 - 1/6, though one of them is wrong.
  CHECK(stage("[7]").run(example()).measure("counted") == Approx(5.0 / 6.0));
  CHECK(stage("[1]").set("cluster", "0").run(example()).measure("counted") == Approx(-0.5));
}

TEST_CASE("a cluster can be named") {
  const Outcome outcome = stage("[7]").set("cluster", "1").run(example());
  CHECK(outcome.measure("precision") == Approx(1.0 / 3.0));
  CHECK(outcome.measure("recall") == Approx(1.0 / 6.0));
}

TEST_CASE("an object may have several labels") {
  const Outcome outcome = stage("[7, 1]").run(example());
  CHECK(outcome.measure("precision") == 1.0);
  CHECK(outcome.measure("recall") == Approx(5.0 / 8.0));
}

TEST_CASE("the table has a row for each cluster that holds a true point") {
  const Outcome outcome = stage("[7]").run(example());
  const velum::Table& table = outcome.get<velum::Table>();
  REQUIRE(table.size() == 2);
  CHECK(table.number(1, "cluster") == 1.0);
  CHECK(table.number(1, "correct") == 1.0);
  CHECK(table.number(1, "points") == 3.0);
}

TEST_CASE("a cloud is judged against the whole scene") {
  const Outcome outcome =
      stage("[7]").run(labelled({7, 7, 7, 1}), labelled({7, 7, 7, 7, 7, 7, 1, 1, 2, 2}));
  CHECK(outcome.measure("precision") == Approx(0.75));
  CHECK(outcome.measure("recall") == Approx(0.5));
  CHECK(outcome.measure("iou") == Approx(3.0 / 7.0));
}

TEST_CASE("without the whole scene recall is not made up") {
  const Outcome outcome = stage("[7]").run(labelled({7, 7, 7, 1}));
  CHECK(outcome.measure("precision") == Approx(0.75));
  CHECK(outcome.measures.count("recall") == 0);
  REQUIRE(outcome.warnings.size() == 1);
  CHECK(outcome.warnings.front().find("reference") != std::string::npos);
}

TEST_CASE("a perfect result scores one") {
  const Outcome outcome = stage("[3]").run(clusters({3, 3, 4}, {0, 0, 1}));
  CHECK(outcome.measure("precision") == 1.0);
  CHECK(outcome.measure("recall") == 1.0);
  CHECK(outcome.measure("iou") == 1.0);
}

TEST_CASE("a label that no point has is warned of") {
  const Outcome outcome = stage("[42]").run(example());
  CHECK(outcome.measure("recall") == 0.0);
  REQUIRE(outcome.warnings.size() == 1);
  CHECK(outcome.warnings.front().find("42") != std::string::npos);
}

TEST_CASE("a cluster that does not exist, no label, and points without labels are errors") {
  CHECK_THROWS_AS(stage("[7]").set("cluster", "5").run(example()), velum::Error);
  CHECK_THROWS_AS(stage("[]").run(example()), velum::Error);
  CHECK_THROWS_AS(Stage("analysis.segmentation_score").run(example()), velum::Error);
  CHECK_THROWS_AS(stage("[7]").run(labelled({7}).without("label")), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault :
       velum::test::conformance("analysis.segmentation_score", {{"label", "[1]"}}))
    FAIL_CHECK(fault);
}
