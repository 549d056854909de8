// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "reconstruct.hpp"

#include <pcl/point_types.h>
#include <pcl/surface/poisson.h>

#include <algorithm>
#include <mutex>

#include "pcl/clouds.hpp"

namespace velum::meshing {
namespace {

constexpr int kLeastDepth = 5;  // of the tree, where it is deeper

void set_up(pcl::Poisson<pcl::PointNormal>& poisson, const PoissonRules& rules) {
  poisson.setDepth(rules.depth);
  poisson.setMinDepth(std::min(kLeastDepth, rules.depth));
  poisson.setSolverDivide(std::max(rules.solver_divide, std::min(kLeastDepth, rules.depth)));
  poisson.setIsoDivide(std::max(rules.iso_divide, std::min(kLeastDepth, rules.depth)));
  poisson.setScale(static_cast<float>(rules.scale));
  poisson.setSamplesPerNode(static_cast<float>(rules.samples_per_node));
  poisson.setPointWeight(static_cast<float>(rules.point_weight));
  poisson.setOutputPolygons(false);
  poisson.setManifold(true);
  poisson.setThreads(1);  // its sums would depend on the number
}

}  // namespace

Draft poisson_surface(const Cloud& cloud, const PoissonRules& rules) {
  // The library keeps its pools of memory in static variables.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  pcl::PointCloud<pcl::PointNormal> vertices;
  std::vector<pcl::Vertices> faces;
  with_pcl::quietly("PCL's Poisson reconstruction", [&] {
    pcl::Poisson<pcl::PointNormal> poisson;
    set_up(poisson, rules);
    poisson.setInputCloud(with_pcl::oriented(cloud));
    poisson.reconstruct(vertices, faces);
  });
  Draft draft;
  draft.positions = with_pcl::positions_of(vertices);
  for (const pcl::Vertices& face : faces) {
    const auto corner = [&](std::size_t i) { return static_cast<std::int32_t>(face.vertices[i]); };
    for (std::size_t i = 2; i < face.vertices.size(); ++i)
      draft.triangles.push_back({corner(0), corner(i - 1), corner(i)});
  }
  if (!draft.positions.allFinite())
    throw Error(Fault::stage,
                "PCL's Poisson reconstruction made vertices that are not finite numbers")
        .hint("check that the normals agree with each other, or use a smaller depth");
  return draft;
}

}  // namespace velum::meshing
