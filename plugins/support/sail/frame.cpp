// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "sail/frame.hpp"

#include <algorithm>
#include <vector>

namespace velum::sail {

Frame make_frame(const Eigen::Vector3d& up, const Eigen::Vector3d& bow,
                 const Eigen::Vector3d& origin) {
  const Eigen::Vector3d z = up.normalized();
  const Eigen::Vector3d forward = bow - bow.dot(z) * z;
  if (!(up.norm() > 0.0) || !(forward.norm() > 1e-6 * bow.norm()))
    throw Error(Fault::graph, "'up' and 'bow' are zero or parallel")
        .hint("up points to the masthead, bow to the front of the boat");
  Frame frame;
  frame.origin = origin;
  frame.axes.row(0) = -forward.normalized();
  frame.axes.row(2) = z;
  frame.axes.row(1) = z.cross(Eigen::Vector3d(frame.axes.row(0)));
  return frame;
}

double median_edge(const Eigen::Matrix3Xd& polygon) {
  std::vector<double> edges;
  for (Index i = 0; i < polygon.cols(); ++i)
    edges.push_back((polygon.col((i + 1) % polygon.cols()) - polygon.col(i)).norm());
  const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
  std::nth_element(edges.begin(), middle, edges.end());
  return *middle;
}

}  // namespace velum::sail
