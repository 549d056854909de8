// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "geometry/region_growing.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <velum/stage.hpp>

#include "geometry/eigen3.hpp"
#include "geometry/growing_parameters.hpp"
#include "geometry/moments.hpp"

namespace {

using velum::Index;
using velum::geometry::Regions;

// One row of the table of clusters: what helps to tell a sail from a wall.
std::vector<velum::Cell> describe(const velum::Cloud& cloud, const Regions& regions, Index number,
                                  const std::vector<std::int32_t>& members) {
  const auto positions = cloud.positions();
  const Eigen::Vector3f first = positions.col(members.front());
  velum::geometry::NeighbourMoments moments;
  for (const std::int32_t i : members) moments.add(positions.col(i) - first);
  const auto axes = velum::geometry::eigen3(moments.covariance());
  const Eigen::Vector3d centre = cloud.origin() + first.cast<double>() + moments.mean();

  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;
  double area = 0.0;
  for (const std::int32_t i : members) {
    const Eigen::Vector3d normal = cloud.normals().col(i).cast<double>();
    // Both sides of a sheet count alike.
    sum += normal.dot(sum) < 0.0 ? Eigen::Vector3d(-normal) : normal;
    const Eigen::Vector3d along =
        axes.vectors.transpose() * (positions.col(i) - first).cast<double>();
    low = low.cwiseMin(along);
    high = high.cwiseMax(along);
    area += static_cast<double>(regions.areas[i]);
  }
  const Eigen::Vector3d normal = sum.normalized();
  const Eigen::Vector3d extent = high - low;
  return {static_cast<std::int64_t>(number),
          static_cast<std::int64_t>(members.size()),
          area,
          centre.x(),
          centre.y(),
          centre.z(),
          normal.x(),
          normal.y(),
          normal.z(),
          extent[2],
          extent[1],
          extent[0],
          std::sqrt(std::max(axes.values[0], 0.0))};
}

velum::Table describe_all(const velum::Cloud& cloud, const Regions& regions,
                          velum::Context& context) {
  velum::Table table({{"cluster", ""},
                      {"points", ""},
                      {"area", "m^2"},
                      {"centre_x", "m"},
                      {"centre_y", "m"},
                      {"centre_z", "m"},
                      {"normal_x", ""},
                      {"normal_y", ""},
                      {"normal_z", ""},
                      {"length", "m"},
                      {"width", "m"},
                      {"depth", "m"},
                      {"flatness", "m"}});
  std::vector<std::vector<std::int32_t>> members(regions.sizes.size());
  for (std::size_t r = 0; r < members.size(); ++r)
    members[r].reserve(static_cast<std::size_t>(regions.sizes[r]));
  for (Index i = 0; i < regions.labels.size(); ++i)
    if (regions.labels[i] >= 0)
      members[static_cast<std::size_t>(regions.labels[i])].push_back(static_cast<std::int32_t>(i));
  std::vector<std::vector<velum::Cell>> rows(members.size());
  velum::parallel_for(context, static_cast<Index>(members.size()), 1, [&](Index begin, Index end) {
    for (Index r = begin; r < end; ++r)
      rows[static_cast<std::size_t>(r)] =
          describe(cloud, regions, r, members[static_cast<std::size_t>(r)]);
  });
  for (auto& row : rows) table.add(std::move(row));
  return table;
}

struct RegionGrowing {
  int neighbours = 50;
  velum::Angle smoothness = {7.0 * std::numbers::pi / 180.0};
  double curvature = 0.05;
  int min_size = 100;
  std::optional<int> max_size;

  static auto about() {
    velum::About<RegionGrowing> about("Smooth regions, grown over normals and curvature.");
    about.in("cloud")
        .needs("cloud", "normals")
        .needs("cloud", "curvature")
        .out("clusters", "numbered from the largest to the smallest");
    return velum::geometry::add_growing(about)
        .deterministic()
        .reference("thesis 3.3.3: Algorithm 3.5, tables 3.28 and 3.29")
        .reference(
            "T. Rabbani et al., Segmentation of Point Clouds Using Smoothness Constraint "
            "(2006)");
  }

  void check() const {
    if (max_size.value_or(std::numeric_limits<int>::max()) < min_size)
      throw velum::Error(velum::Fault::graph,
                         fmt::format("max_size {} is below min_size {}", *max_size, min_size))
          .at("max_size");
  }

  velum::Clusters operator()(const velum::Cloud& cloud, velum::Context& context) const {
    velum::geometry::GrowingOptions options;
    options.neighbours = neighbours;
    options.smoothness = smoothness;
    options.curvature = curvature;
    options.min_size = min_size;
    if (max_size) options.max_size = *max_size;
    Regions regions = velum::geometry::grow_regions(cloud, options, context);
    report(cloud, regions, context);
    velum::Table kinds = describe_all(cloud, regions, context);
    return {cloud, velum::Column(std::move(regions.labels)), std::move(kinds)};
  }

 private:
  void report(const velum::Cloud& cloud, const Regions& regions, velum::Context& context) const {
    const auto points = static_cast<double>(cloud.size());
    const auto assigned = static_cast<double>((regions.labels.array() >= 0).count());
    context.measure("clusters", static_cast<double>(regions.sizes.size()), "");
    context.measure("assigned", cloud.empty() ? 0.0 : assigned / points, "");
    context.measure("largest", static_cast<double>(regions.largest), "");
    if (curvature > 1.0 / 3.0)
      context.warn(
          fmt::format("curvature = {} switches the curvature test off: λ0/Σλ is never "
                      "above 1/3",
                      curvature));
    if (!cloud.empty() && regions.largest < min_size)
      context.warn(
          fmt::format("min_size = {} is more than the largest region holds ({} points): "
                      "no cluster is left",
                      min_size, regions.largest));
    if (regions.too_large > 0)
      context.warn(
          fmt::format("{} region(s) of more than max_size points were refused, the "
                      "largest with {}",
                      regions.too_large, regions.largest));
  }
};

}  // namespace
VELUM_STAGE(RegionGrowing)
