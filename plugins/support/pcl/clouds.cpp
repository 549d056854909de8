// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "pcl/clouds.hpp"

#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <new>
#include <velum/error.hpp>

namespace velum::with_pcl {
namespace {

template <class Point>
std::shared_ptr<pcl::PointCloud<Point>> sized(const Cloud& cloud) {
  auto made = std::make_shared<pcl::PointCloud<Point>>();
  made->resize(static_cast<std::size_t>(cloud.size()));
  return made;
}

template <class Point>
void set_positions(const Cloud& cloud, pcl::PointCloud<Point>& to) {
  const ConstPoints from = cloud.positions();
  for (Index i = 0; i < cloud.size(); ++i)
    to[static_cast<std::size_t>(i)].getVector3fMap() = from.col(i);
}

template <class Point>
void set_normals(const Cloud& cloud, pcl::PointCloud<Point>& to) {
  const ConstPoints from = cloud.normals();
  const bool curved = cloud.has("curvature");
  for (Index i = 0; i < cloud.size(); ++i) {
    Point& point = to[static_cast<std::size_t>(i)];
    point.getNormalVector3fMap() = from.col(i);
    point.curvature = curved ? cloud.curvature()[i] : 0.0F;
  }
}

template <class Point>
Points points_of(const pcl::PointCloud<Point>& cloud) {
  Points points(3, static_cast<Index>(cloud.size()));
  for (Index i = 0; i < points.cols(); ++i)
    points.col(i) = cloud[static_cast<std::size_t>(i)].getVector3fMap();
  return points;
}

}  // namespace

std::shared_ptr<pcl::PointCloud<pcl::PointXYZ>> positions(const Cloud& cloud) {
  auto made = sized<pcl::PointXYZ>(cloud);
  set_positions(cloud, *made);
  return made;
}

std::shared_ptr<pcl::PointCloud<pcl::Normal>> normals(const Cloud& cloud) {
  auto made = sized<pcl::Normal>(cloud);
  set_normals(cloud, *made);
  return made;
}

std::shared_ptr<pcl::PointCloud<pcl::PointNormal>> oriented(const Cloud& cloud) {
  auto made = sized<pcl::PointNormal>(cloud);
  set_positions(cloud, *made);
  set_normals(cloud, *made);
  return made;
}

Points positions_of(const pcl::PointCloud<pcl::PointXYZ>& cloud) {
  return points_of(cloud);
}

Points positions_of(const pcl::PointCloud<pcl::PointNormal>& cloud) {
  return points_of(cloud);
}

Points normals_of(const pcl::PointCloud<pcl::PointNormal>& cloud) {
  Points normals(3, static_cast<Index>(cloud.size()));
  for (Index i = 0; i < normals.cols(); ++i)
    normals.col(i) = cloud[static_cast<std::size_t>(i)].getNormalVector3fMap();
  return normals;
}

Eigen::VectorXf curvature_of(const pcl::PointCloud<pcl::PointNormal>& cloud) {
  Eigen::VectorXf curvature(static_cast<Index>(cloud.size()));
  for (Index i = 0; i < curvature.size(); ++i)
    curvature[i] = cloud[static_cast<std::size_t>(i)].curvature;
  return curvature;
}

void quietly(const std::string& what, const std::function<void()>& call) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  try {
    call();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const Error&) {
    throw;
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(Fault::stage, what + " failed: " + error.what());
  }
}

}  // namespace velum::with_pcl
