// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>

#include <numbers>
#include <velum/stage.hpp>

#include "mesh/build.hpp"
#include "pcl/clouds.hpp"

namespace {

using velum::Better;
using velum::Cloud;
using velum::Context;
using velum::Index;
using velum::Mesh;
using velum::mesh::Triangle;

constexpr double kDegree = std::numbers::pi / 180.0;

struct GreedyProjection {
  double mu = 5.0;
  int neighbours = 100;
  velum::Length max_edge = velum::spacings(8);
  velum::Angle min_angle{10.0 * kDegree};
  velum::Angle max_angle{150.0 * kDegree};
  velum::Angle max_surface_angle{45.0 * kDegree};

  static auto about() {
    return velum::About<GreedyProjection>(
               "PCL's greedy projection: each point is joined to its neighbours in the order of "
               "their angles around it.")
        .in("cloud")
        .needs("cloud", "normals")
        .out("mesh")
        .param(&GreedyProjection::mu, "mu",
               "neighbours are looked for within mu times the distance to the nearest one",
               velum::at_least(1.0))
        .param(&GreedyProjection::neighbours, "neighbours", "looked at around a point, at most",
               velum::between(4, 1000))
        .param(&GreedyProjection::max_edge, "max_edge", "longest edge", velum::above(0.0))
        .param(&GreedyProjection::min_angle, "min_angle", "smallest angle that is aimed at",
               velum::between(0.0, std::numbers::pi / 3.0))
        .param(&GreedyProjection::max_angle, "max_angle", "largest angle of a triangle",
               velum::between(std::numbers::pi / 3.0, std::numbers::pi))
        .param(&GreedyProjection::max_surface_angle, "max_surface_angle",
               "points whose normals differ by more are not joined",
               velum::between(0.0, std::numbers::pi))
        .isolated()
        .reference("thesis 3.5.1, Algorithm 3.6 and table 3.32")
        .reference(
            "Marton, Rusu and Beetz, On fast surface reconstruction methods for large and noisy "
            "point clouds, ICRA 2009");
  }

  Mesh operator()(const Cloud& cloud, Context& context) const;

 private:
  [[nodiscard]] std::vector<Triangle> reconstruct(const Cloud& cloud) const;
};

/// The points that PCL can take: the first of those at one place, with a normal of length one.
/// Coinciding points have a nearest neighbour at distance zero, and PCL joins them to nothing.
std::vector<std::int32_t> usable(const Cloud& cloud) {
  const std::vector<std::int32_t> first = velum::mesh::first_of_equal(cloud.positions());
  const auto normals = cloud.normals();
  std::vector<std::int32_t> found;
  for (std::int32_t i = 0; i < cloud.size(); ++i)
    if (first[static_cast<std::size_t>(i)] == i && std::abs(normals.col(i).norm() - 1.0F) < 1e-3F)
      found.push_back(i);
  return found;
}

std::vector<Triangle> GreedyProjection::reconstruct(const Cloud& cloud) const {
  std::vector<pcl::Vertices> faces;
  velum::with_pcl::quietly("PCL's greedy projection", [&] {
    pcl::GreedyProjectionTriangulation<pcl::PointNormal> triangulation;
    triangulation.setMu(mu);
    triangulation.setMaximumNearestNeighbors(neighbours);
    triangulation.setSearchRadius(max_edge);
    triangulation.setMinimumAngle(min_angle);
    triangulation.setMaximumAngle(max_angle);
    triangulation.setMaximumSurfaceAngle(max_surface_angle);
    triangulation.setNormalConsistency(!cloud.sensors().empty());
    const auto tree = pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>();
    triangulation.setSearchMethod(tree);
    triangulation.setInputCloud(velum::with_pcl::oriented(cloud));
    triangulation.reconstruct(faces);
  });
  std::vector<Triangle> triangles;
  for (const pcl::Vertices& face : faces) {
    if (face.vertices.size() != 3) continue;
    const auto corner = [&](std::size_t i) { return static_cast<std::int32_t>(face.vertices[i]); };
    const Triangle t{corner(0), corner(1), corner(2)};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }
  return triangles;
}

Mesh GreedyProjection::operator()(const Cloud& input, Context& context) const {
  context.check();
  const std::vector<std::int32_t> points = usable(input);
  const Cloud cloud = input.select(points);
  if (cloud.size() < input.size())
    context.info(std::to_string(input.size() - cloud.size()) +
                 " points are not used: they lie on another, or their normal has no length");
  std::vector<Triangle> triangles;
  if (cloud.size() >= 4 && cloud.diagonal() > 0.0) triangles = reconstruct(cloud);
  context.check();
  context.progress(0.9);
  velum::mesh::orient(triangles, cloud);
  if (triangles.empty())
    context.warn("no triangle: fewer than four points, or none has a neighbour within reach");
  Mesh mesh = velum::mesh::mesh_over(triangles, cloud);
  const velum::mesh::Adjacency adjacency = velum::mesh::adjacency(mesh.triangles());
  const std::size_t loops = velum::mesh::border_loops(mesh.triangles(), adjacency).size();
  if (loops > 1)
    context.warn("the mesh has " + std::to_string(loops) +
                 " borders: holes and loose parts; a larger mu or max_edge closes some of them");
  context.measure("triangles", static_cast<double>(mesh.size()), "");
  context.measure("loops", static_cast<double>(loops), "", Better::lower);
  context.measure("unused_points", static_cast<double>(input.size() - mesh.vertices().size()), "",
                  Better::lower);
  return mesh;
}

}  // namespace
VELUM_STAGE(GreedyProjection)
