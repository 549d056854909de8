// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/overlap.hpp"

namespace velum::registration {

std::vector<std::int32_t> overlapping(const Cloud& cloud, const Cloud& other, const Pose& pose,
                                      double radius, Context& context) {
  if (cloud.empty() || other.empty()) return {};
  const auto positions = cloud.positions();
  const Neighbours& neighbours = other.neighbours();
  std::vector<char> near(static_cast<std::size_t>(cloud.size()), 0);
  parallel_for(context, cloud.size(), 2048, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const Eigen::Vector3f moved = (pose * positions.col(i).cast<double>()).cast<float>();
      near[static_cast<std::size_t>(i)] = neighbours.nearest_one(moved, radius).index >= 0 ? 1 : 0;
    }
  });
  std::vector<std::int32_t> indices;
  for (Index i = 0; i < cloud.size(); ++i)
    if (near[static_cast<std::size_t>(i)] != 0) indices.push_back(static_cast<std::int32_t>(i));
  return indices;
}

}  // namespace velum::registration
