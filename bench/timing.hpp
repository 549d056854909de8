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
  velum::Cloud moved;    ///< the same sail, with normals, to be registered to `cloud`
  velum::Cloud normals;  ///< `cloud` with normals and curvature from 50 neighbours
  velum::Cloud smooth;   ///< `cloud` smoothed, with normals: what is meshed
  velum::Cloud scene;    ///< a scan of the wind tunnel, with normals and curvature
  velum::Cloud other;    ///< the same by the other scanner, in that one's frame, points alone
  double radius = 0.0;   ///< holds 50 neighbours on average on the sail [m]
  double gap = 0.0;      ///< parts the things of the scene [m]
  std::string folder;    ///< holds `cloud` as cloud.pcd, .ply, .xyz, .csv, .las, cloud_ascii.pcd
};

using Prepare = std::function<std::function<void()>(const Input&)>;

/// One way to do one operation. `prepare` makes the work, unmeasured; the work is measured.
struct Contender {
  std::string operation;
  std::string name;
  Prepare prepare;
  velum::Index max_points = 0;  ///< takes too long for larger clouds; 0: for none
  std::string file = "";        ///< of the folder, that is read: for MB/s
};
using Contenders = std::vector<Contender>;

/// Sizes to which slow contenders are held.
constexpr velum::Index kSlow = 100'000;
constexpr velum::Index kSlowest = 20'000;

Contenders own_features();
Contenders own_filtering();
Contenders own_registration();
Contenders own_segmentation();
Contenders own_resampling();
Contenders own_meshing();
Contenders own_analysis();
Contenders own_files();

Contenders pcl_features();
Contenders pcl_filtering();
Contenders pcl_icp();
Contenders pcl_registration();
Contenders pcl_segmentation();
Contenders pcl_resampling();
Contenders pcl_meshing();
Contenders pcl_analysis();
Contenders pcl_files();
Contenders cgal_points();
Contenders cgal_surfaces();
Contenders open3d_points();
Contenders open3d_surfaces();

/// Seconds of each contender: the median of rounds in which all take turns; not a number for one
/// that refuses the input.
std::vector<double> measure(const Contenders& contenders, const Input& input);

}  // namespace bench
