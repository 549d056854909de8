// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <velum/cloud.hpp>

// PCL's headers stay out of ours: a stage includes those that it calls.
namespace pcl {
template <typename PointT>
class PointCloud;
struct Normal;
struct PointNormal;
struct PointXYZ;
}  // namespace pcl

/// Between our values and PCL's. Positions are relative to the cloud's origin on both sides.
namespace velum::with_pcl {

std::shared_ptr<pcl::PointCloud<pcl::PointXYZ>> positions(const Cloud& cloud);
/// The cloud's `normals`, and its `curvature` where it has one. Throws Error without normals.
std::shared_ptr<pcl::PointCloud<pcl::Normal>> normals(const Cloud& cloud);
/// Both of the above.
std::shared_ptr<pcl::PointCloud<pcl::PointNormal>> oriented(const Cloud& cloud);

Points positions_of(const pcl::PointCloud<pcl::PointXYZ>& cloud);
Points positions_of(const pcl::PointCloud<pcl::PointNormal>& cloud);
Points normals_of(const pcl::PointCloud<pcl::PointNormal>& cloud);
Eigen::VectorXf curvature_of(const pcl::PointCloud<pcl::PointNormal>& cloud);

/// Calls PCL without its messages on the console; what it throws becomes an Error of the stage that
/// begins with `what` ("PCL's Poisson reconstruction").
void quietly(const std::string& what, const std::function<void()>& call);

}  // namespace velum::with_pcl
