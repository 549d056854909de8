// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "global/matches.hpp"

#include <algorithm>
#include <tuple>

#include "features/histograms.hpp"
#include "features/matching.hpp"

namespace velum::registration {
namespace {

/// Features of both signs side by side: column i + size is column i seen from the other side.
Eigen::MatrixXf both_signs(const Eigen::MatrixXf& features) {
  Eigen::MatrixXf both(features.rows(), 2 * features.cols());
  both << features, features::mirrored_fpfh(features);
  return both;
}

struct Pair {
  Index rank;  ///< of each in the other's list, together
  float distance2;
  int source;
  int target;
  bool flipped;
};

}  // namespace

std::vector<Match> match_features(const Sampled& source, const Sampled& target, Index nearest,
                                  Index most, Context& context) {
  const auto ns = static_cast<int>(source.keys.size());
  const auto nt = static_cast<int>(target.keys.size());
  const auto there =
      features::nearest_features(source.features, both_signs(target.features), nearest, context);
  const auto back =
      features::nearest_features(target.features, both_signs(source.features), nearest, context);
  std::vector<Pair> pairs;
  for (int s = 0; s < ns; ++s)
    for (Index i = 0; i < nearest; ++i) {
      const int found = there.index(i, s);
      if (found < 0) continue;
      const bool flipped = found >= nt;
      const int t = flipped ? found - nt : found;
      const int wanted = flipped ? s + ns : s;
      for (Index j = 0; j < nearest; ++j)
        if (back.index(j, t) == wanted)
          pairs.push_back({i + j, there.distance2(i, s), s, t, flipped});
    }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.rank, a.distance2, a.source, a.target) <
           std::tie(b.rank, b.distance2, b.source, b.target);
  });
  if (static_cast<Index>(pairs.size()) > most) pairs.resize(static_cast<std::size_t>(most));
  std::vector<Match> matches;
  const auto at = [](const Sampled& cloud, int key) {
    return cloud.keys[static_cast<std::size_t>(key)];
  };
  for (const Pair& pair : pairs) {
    const auto s = at(source, pair.source);
    const auto t = at(target, pair.target);
    matches.push_back({source.cloud.positions().col(s).cast<double>(),
                       target.cloud.positions().col(t).cast<double>(),
                       source.cloud.normals().col(s).cast<double>(),
                       (pair.flipped ? -1.0 : 1.0) * target.cloud.normals().col(t).cast<double>()});
  }
  return matches;
}

}  // namespace velum::registration
