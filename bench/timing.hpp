// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>
#include <velum/cloud.hpp>

namespace bench {

/// What every contender gets: made once for each size, outside the measured time.
struct Input {
  velum::Cloud cloud;    ///< a sail, random order, sensor known
  velum::Cloud moved;    ///< the same sail, to be registered to `cloud`
  velum::Cloud normals;  ///< `cloud` with normals and curvature from 50 neighbours
  velum::Cloud smooth;   ///< `cloud` smoothed, with normals: what is meshed
  double radius = 0.0;   ///< holds 50 neighbours on average [m]
  std::string folder;    ///< holds cloud.pcd, cloud_ascii.pcd, cloud.ply
};

/// One way to do one operation. `prepare` makes the work, unmeasured; the work is measured.
struct Contender {
  std::string operation;
  std::string name;
  std::function<std::function<void()>(const Input&)> prepare;
};

std::vector<Contender> ours();
std::vector<Contender> our_small_ones();
std::vector<Contender> pcl_contenders();
std::vector<Contender> open3d_contenders();
std::vector<Contender> cgal_contenders();

/// Seconds of each contender: the median of rounds in which all take turns.
std::vector<double> measure(const std::vector<Contender>& contenders, const Input& input);

}  // namespace bench
