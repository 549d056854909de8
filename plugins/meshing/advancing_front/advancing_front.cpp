// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "cgal/advancing_front.hpp"

#include <velum/stage.hpp>

#include "mesh/build.hpp"

namespace {

using velum::Better;
using velum::Cloud;
using velum::Context;
using velum::Mesh;
using velum::mesh::Triangle;

struct AdvancingFront {
  double radius_ratio = 5.0;
  velum::Angle beta{0.52};
  std::optional<velum::Length> max_edge = velum::spacings(8);
  bool largest_part = true;

  static auto about() {
    return velum::About<AdvancingFront>(
               "A surface grown triangle by triangle through the Delaunay tetrahedra of the cloud.")
        .in("cloud")
        .out("mesh")
        .param(&AdvancingFront::radius_ratio, "radius_ratio",
               "a triangle whose sphere is this many times larger than its neighbour's ends the "
               "surface",
               velum::at_least(1.0))
        .param(&AdvancingFront::beta, "beta",
               "half the angle of the wedge behind an edge in which the next triangle is chosen by "
               "its size alone",
               velum::between(0.0, 1.5707963267948966))
        .advanced()
        .param(&AdvancingFront::max_edge, "max_edge", "longest edge", velum::above(0.0))
        .param(&AdvancingFront::largest_part, "largest_part",
               "keep the largest of the surfaces found, drop the others")
        // CGAL orders what comes up at the same time by its place in memory.
        .tolerant()
        .reference(
            "Cohen-Steiner and Da, A greedy Delaunay-based surface reconstruction algorithm, The "
            "Visual Computer 20 (2004)")
        .reference("The CGAL project, Advancing Front Surface Reconstruction")
        .licence("GPL-3.0-or-later");
  }

  Mesh operator()(const Cloud& cloud, Context& context) const;
};

std::vector<Triangle> reconstruct(const Cloud& cloud, const velum::cgal::FrontRules& rules) {
  try {
    return velum::cgal::advancing_front(cloud.positions().cast<double>(), rules);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw velum::Error(velum::Fault::stage,
                       std::string("CGAL's advancing front failed: ") + error.what());
  }
}

Mesh AdvancingFront::operator()(const Cloud& cloud, Context& context) const {
  context.check();
  velum::cgal::FrontRules rules;
  rules.radius_ratio = radius_ratio;
  rules.beta = beta;
  rules.max_edge = max_edge ? max_edge->value : 0.0;
  std::vector<Triangle> triangles;
  if (cloud.size() >= 3) triangles = reconstruct(cloud, rules);
  context.check();
  context.progress(0.9);
  const velum::Index dropped =
      largest_part ? velum::mesh::keep_parts(triangles, cloud.positions(), 1.0) : 0;
  velum::mesh::orient(triangles, cloud);
  if (triangles.empty())
    context.warn(
        "no triangle: fewer than three points, points on a line, or every edge is longer than "
        "max_edge");
  Mesh mesh = velum::mesh::mesh_over(triangles, cloud);
  context.measure("triangles", static_cast<double>(mesh.size()), "");
  context.measure("parts_dropped", static_cast<double>(dropped), "", Better::lower);
  context.measure("unused_points", static_cast<double>(cloud.size() - mesh.vertices().size()), "",
                  Better::lower);
  return mesh;
}

}  // namespace
VELUM_STAGE(AdvancingFront)
