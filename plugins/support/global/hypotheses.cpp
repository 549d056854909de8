// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "global/hypotheses.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/motion.hpp"
#include "global/consistency.hpp"
#include "global/robust_fit.hpp"

namespace velum::registration {
namespace {

constexpr int kSeeds = 160;
constexpr std::size_t kLeastClique = 4;
/// Points of a pair must be this many bounds apart for their distance to tell anything.
constexpr double kShortest = 4.0;
/// A match that is consistent with this share of a clique takes part in its fit.
constexpr double kSupport = 0.8;
constexpr double kSameTurn = 0.1;
constexpr double kSameShift = 3.0;
constexpr double kNormalCosine = 0.7;

std::vector<std::int32_t> supporters(const ConsistencyGraph& graph,
                                     const std::vector<std::int32_t>& clique) {
  std::vector<std::int32_t> chosen;
  for (std::size_t m = 0; m < graph.size(); ++m) {
    std::size_t joined = 0;
    for (const std::int32_t other : clique) {
      const auto at = static_cast<std::size_t>(other);
      joined += at == m || graph.joined(m, at) ? 1 : 0;
    }
    if (static_cast<double>(joined) >= kSupport * static_cast<double>(clique.size()))
      chosen.push_back(static_cast<std::int32_t>(m));
  }
  return chosen;
}

/// Matches to begin cliques with: those in the densest cores, each not yet in a clique.
std::vector<std::vector<std::int32_t>> cliques_of(const ConsistencyGraph& graph, Context& context) {
  const std::vector<int> core = graph.core_numbers();
  std::vector<std::int32_t> order(graph.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const auto i = static_cast<std::size_t>(a);
    const auto j = static_cast<std::size_t>(b);
    return core[i] != core[j] ? core[i] > core[j] : graph.degree(i) > graph.degree(j);
  });
  std::vector<char> used(graph.size(), 0);
  std::vector<std::vector<std::int32_t>> cliques;
  int seeds = 0;
  for (const std::int32_t seed : order) {
    const auto at = static_cast<std::size_t>(seed);
    if (used[at] != 0) continue;
    if (++seeds > kSeeds || core[at] + 1 < static_cast<int>(kLeastClique)) break;
    context.check();
    std::vector<std::int32_t> clique = graph.clique_of(at);
    for (const std::int32_t member : clique) used[static_cast<std::size_t>(member)] = 1;
    if (clique.size() >= kLeastClique) cliques.push_back(std::move(clique));
  }
  return cliques;
}

}  // namespace

Index inliers_of(const std::vector<Match>& matches, const Pose& pose, double bound) {
  Index inliers = 0;
  for (const Match& match : matches)
    inliers += (pose * match.from - match.to).squaredNorm() < bound * bound &&
                       (pose.linear() * match.from_normal).dot(match.to_normal) > kNormalCosine
                   ? 1
                   : 0;
  return inliers;
}

bool same_motion(const Pose& a, const Pose& b, const Eigen::Vector3d& place, double bound) {
  const auto apart = geometry::difference(a, b, place);
  return apart.rotation < kSameTurn && apart.translation < kSameShift * bound;
}

std::vector<Hypothesis> hypotheses_of(const std::vector<Match>& matches, double bound,
                                      const Eigen::Vector3d& place, std::size_t most,
                                      Context& context) {
  const ConsistencyGraph graph(matches, {.length = bound, .shortest = kShortest * bound}, context);
  const auto cliques = cliques_of(graph, context);
  std::vector<Hypothesis> found(cliques.size());
  parallel_for(context, static_cast<Index>(cliques.size()), 1, [&](Index begin, Index) {
    const auto at = static_cast<std::size_t>(begin);
    const RobustFit fit = robust_fit(matches, supporters(graph, cliques[at]), bound);
    if (fit.fixed) found[at] = {fit.pose, inliers_of(matches, fit.pose, bound)};
  });
  std::stable_sort(found.begin(), found.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.inliers > b.inliers; });
  std::vector<Hypothesis> distinct;
  for (const Hypothesis& one : found) {
    if (one.inliers < 3 || distinct.size() == most) break;
    if (std::none_of(distinct.begin(), distinct.end(), [&](const Hypothesis& other) {
          return same_motion(one.pose, other.pose, place, bound);
        }))
      distinct.push_back(one);
  }
  return distinct;
}

}  // namespace velum::registration
