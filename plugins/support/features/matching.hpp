// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "velum/context.hpp"

namespace velum::features {

/// The `k` columns of `set` nearest to each column of `queries` (Euclidean), k rows, ascending by
/// distance, then index; -1 and infinity where the set has fewer.
struct NearestFeatures {
  Eigen::MatrixXi index;
  Eigen::MatrixXf distance2;
};
/// Exhaustive, by products of blocks: for some thousand features of some dozen bins no tree is
/// faster. Distances are right to about 1e-6 of the features' squared length.
NearestFeatures nearest_features(const Eigen::MatrixXf& queries, const Eigen::MatrixXf& set,
                                 Index k, Context& context);

}  // namespace velum::features
