// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "global/consistency.hpp"
#include "global/hypotheses.hpp"
#include "global/test_matches.hpp"
#include "registration/test_context.hpp"

using namespace velum::registration;
using namespace velum::registration::test;
using velum::Pose;
using velum::test::PlainContext;

namespace {

const ConsistencyGraph::Limits kLimits{.length = 0.01, .shortest = 0.05};

/// Matches of level points with normals upwards: where each is and where it goes to.
std::vector<Match> level(const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& places) {
  std::vector<Match> matches;
  for (const auto& [from, to] : places)
    matches.push_back({{from.x(), from.y(), 0.0},
                       {to.x(), to.y(), 0.0},
                       Eigen::Vector3d::UnitZ(),
                       Eigen::Vector3d::UnitZ()});
  return matches;
}

}  // namespace

TEST_CASE("matches of one motion are a clique, found from each of them") {
  PlainContext context;
  const ConsistencyGraph graph(planted(12, 40, some_motion()), kLimits, context);
  REQUIRE(graph.size() == 52);
  std::vector<std::int32_t> all(12);
  for (std::int32_t i = 0; i < 12; ++i) all[static_cast<std::size_t>(i)] = i;
  for (std::size_t i = 0; i < 12; ++i) {
    CHECK(graph.core_numbers()[i] >= 11);
    auto clique = graph.clique_of(i);
    std::sort(clique.begin(), clique.end());
    CHECK(clique == all);
  }
  for (std::size_t i = 12; i < 52; ++i) CHECK(graph.core_numbers()[i] < 11);
}

TEST_CASE("a triangle with a tail: degrees, cores and cliques are known") {
  // 0, 1 and 2 stay; 3 keeps its distance to 0 alone.
  PlainContext context;
  const ConsistencyGraph graph(
      level({{{0, 0}, {0, 0}}, {{1, 0}, {1, 0}}, {{0, 1}, {0, 1}}, {{1, 1}, {-1.4142, 0}}}),
      kLimits, context);
  CHECK(graph.joined(0, 3));
  CHECK(graph.joined(3, 0));
  CHECK_FALSE(graph.joined(1, 3));
  CHECK_FALSE(graph.joined(2, 3));
  CHECK(graph.degree(0) == 3);
  CHECK(graph.degree(3) == 1);
  CHECK(graph.core_numbers() == std::vector<int>{2, 2, 2, 1});
  CHECK(graph.clique_of(1).size() == 3);
  CHECK(graph.clique_of(3) == std::vector<std::int32_t>{3, 0});
}

TEST_CASE("a mirror image keeps all lengths and angles, but not the hand") {
  PlainContext context;
  auto matches = planted(20, 0, Pose::Identity());
  for (Match& match : matches) {
    match.to.x() *= -1.0;
    match.to_normal.x() *= -1.0;
  }
  const ConsistencyGraph graph(matches, kLimits, context);
  int edges = 0;
  for (std::size_t i = 0; i < graph.size(); ++i) edges += graph.degree(i);
  // Where both normals and the line lie nearly in a plane the hand does not show.
  CHECK(edges < 20 * 19 / 2);
}

TEST_CASE("normals that turn by another angle part what the lengths would join") {
  PlainContext context;
  auto matches = level({{{0, 0}, {0, 0}}, {{1, 0}, {1, 0}}});
  CHECK(ConsistencyGraph(matches, kLimits, context).joined(0, 1));
  matches[1].to_normal = Eigen::Vector3d(0.0, 0.8, 0.6);
  CHECK_FALSE(ConsistencyGraph(matches, kLimits, context).joined(0, 1));
}

TEST_CASE("graphs of nothing, of one match, of matches in one place and of no numbers") {
  PlainContext context;
  const ConsistencyGraph none({}, kLimits, context);
  CHECK(none.size() == 0);
  CHECK(none.core_numbers().empty());
  const ConsistencyGraph one(planted(1, 0, some_motion()), kLimits, context);
  CHECK(one.core_numbers() == std::vector<int>{0});
  CHECK(one.clique_of(0) == std::vector<std::int32_t>{0});
  const ConsistencyGraph same(std::vector<Match>(5, planted(1, 0, some_motion())[0]), kLimits,
                              context);
  CHECK(same.degree(0) == 0);
  auto matches = planted(6, 0, some_motion());
  matches[2].to.y() = std::numeric_limits<double>::quiet_NaN();
  matches[4].from_normal.x() = std::numeric_limits<double>::quiet_NaN();
  const ConsistencyGraph broken(matches, kLimits, context);
  CHECK(broken.degree(2) == 0);
  CHECK(broken.degree(4) == 0);
  CHECK(broken.joined(0, 1));
}

TEST_CASE("the motion of a fifth of the matches comes first, with any number of threads") {
  PlainContext one(1);
  PlainContext two(2);
  for (const Eigen::Vector3d& centre :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1e7, -2e6, 5e5)}) {
    const Pose motion = some_motion();
    const auto matches = planted(40, 160, motion, 0.003, centre);
    const auto found = hypotheses_of(matches, 0.01, centre, 5, one);
    REQUIRE(!found.empty());
    CHECK(found[0].inliers >= 40);
    CHECK(((found[0].pose * centre) - (motion * centre)).norm() < 0.003);
    CHECK(same_motion(found[0].pose, motion, centre, 0.01));
    CHECK(inliers_of(matches, found[0].pose, 0.01) == found[0].inliers);
    const auto again = hypotheses_of(matches, 0.01, centre, 5, two);
    REQUIRE(again.size() == found.size());
    CHECK(again[0].pose.matrix() == found[0].pose.matrix());
  }
}

TEST_CASE("of two motions both are given, the one with more matches first") {
  PlainContext context;
  auto matches = planted(30, 0, some_motion());
  const auto others = planted(45, 0, Pose::Identity());
  matches.insert(matches.end(), others.begin() + 25, others.end());
  const auto found = hypotheses_of(matches, 0.01, Eigen::Vector3d::Zero(), 5, context);
  REQUIRE(found.size() >= 2);
  CHECK(found[0].inliers == 30);
  CHECK(found[1].inliers == 20);
  CHECK(same_motion(found[1].pose, Pose::Identity(), Eigen::Vector3d::Zero(), 0.01));
}

TEST_CASE("no motion comes of nothing, of three matches, or of matches on a line") {
  PlainContext context;
  const Eigen::Vector3d place = Eigen::Vector3d::Zero();
  CHECK(hypotheses_of({}, 0.01, place, 5, context).empty());
  CHECK(hypotheses_of(planted(3, 0, some_motion()), 0.01, place, 5, context).empty());
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> line;
  for (int i = 0; i < 20; ++i) line.push_back({{0.3 * i, 0.0}, {0.3 * i, 0.0}});
  CHECK(hypotheses_of(level(line), 0.01, place, 5, context).empty());
}
