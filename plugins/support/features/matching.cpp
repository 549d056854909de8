// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "features/matching.hpp"

#include <algorithm>
#include <limits>

namespace velum::features {
namespace {

constexpr Index kBlock = 64;

/// Puts (distance, index) into its place among the k smallest, kept ascending.
template <class Distances, class Indices>
void insert(Distances&& distances, Indices&& indices, float distance, int index) {
  Index at = distances.size() - 1;
  for (; at > 0 && distances[at - 1] > distance; --at) {
    distances[at] = distances[at - 1];
    indices[at] = indices[at - 1];
  }
  distances[at] = distance;
  indices[at] = index;
}

}  // namespace

NearestFeatures nearest_features(const Eigen::MatrixXf& queries, const Eigen::MatrixXf& set,
                                 Index k, Context& context) {
  NearestFeatures found;
  found.index = Eigen::MatrixXi::Constant(k, queries.cols(), -1);
  found.distance2 =
      Eigen::MatrixXf::Constant(k, queries.cols(), std::numeric_limits<float>::infinity());
  if (set.cols() == 0) return found;
  const Eigen::VectorXf half = 0.5F * set.colwise().squaredNorm().transpose();
  parallel_for(context, queries.cols(), kBlock, [&](Index begin, Index end) {
    // |q - s|² = |q|² + 2 (|s|²/2 - q·s): only the bracket orders the set.
    Eigen::MatrixXf order(set.cols(), end - begin);
    order.noalias() = -(set.transpose() * queries.middleCols(begin, end - begin));
    for (Index c = begin; c < end; ++c) {
      auto distances = found.distance2.col(c);
      auto indices = found.index.col(c);
      const float* row = &order(0, c - begin);
      for (Index s = 0; s < set.cols(); ++s) {
        const float value = row[s] + half[s];
        if (value < distances[k - 1]) insert(distances, indices, value, static_cast<int>(s));
      }
      const float length = queries.col(c).squaredNorm();
      for (Index i = 0; i < k; ++i) distances[i] = std::max(0.0F, length + 2.0F * distances[i]);
    }
  });
  return found;
}

}  // namespace velum::features
