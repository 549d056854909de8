// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <omp.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include "timing.hpp"

/// Our clouds as PCL's.
namespace bench {

using Plain = pcl::PointCloud<pcl::PointXYZ>;
using Oriented = pcl::PointCloud<pcl::PointNormal>;
using Normals = pcl::PointCloud<pcl::Normal>;

inline Plain::Ptr plain(const velum::Cloud& cloud) {
  auto out = pcl::make_shared<Plain>();
  const auto p = cloud.positions();
  for (velum::Index i = 0; i < p.cols(); ++i) out->emplace_back(p(0, i), p(1, i), p(2, i));
  return out;
}

inline Oriented::Ptr oriented(const velum::Cloud& cloud) {
  auto out = pcl::make_shared<Oriented>();
  const auto p = cloud.positions();
  const auto n = cloud.normals();
  for (velum::Index i = 0; i < p.cols(); ++i)
    out->emplace_back(p(0, i), p(1, i), p(2, i), n(0, i), n(1, i), n(2, i));
  return out;
}

inline Normals::Ptr normals_of(const velum::Cloud& cloud) {
  auto out = pcl::make_shared<Normals>();
  const auto n = cloud.normals();
  const auto c = cloud.curvature();
  for (velum::Index i = 0; i < n.cols(); ++i) out->emplace_back(n(0, i), n(1, i), n(2, i), c(i));
  return out;
}

template <class Point>
typename pcl::search::KdTree<Point>::Ptr tree() {
  return pcl::make_shared<pcl::search::KdTree<Point>>();
}

}  // namespace bench
