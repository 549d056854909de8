// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "cgal/delaunay_2.hpp"
#include "geometry/normals.hpp"
#include "mesh/build.hpp"
#include "projection.hpp"
#include "trim.hpp"

namespace {

using velum::Cloud;
using velum::Context;
using velum::Index;
using velum::Mesh;
using velum::mesh::Triangle;

enum class Plane { automatic, best_fit, spherical };

/// A triangle whose normal is this far from those of all its vertices is a fold.
constexpr double kFoldCosine = 0.2588;  // 75°
/// Share of folds up to which a projection is good enough not to look for another.
constexpr double kFoldsAllowed = 0.002;

struct Sheet {
  std::vector<Triangle> triangles;
  Index folds = 0;

  [[nodiscard]] double fold_share() const {
    return triangles.empty() ? 1.0
                             : static_cast<double>(folds) / static_cast<double>(triangles.size());
  }
};

struct DelaunayProjected {
  Plane plane = Plane::automatic;
  std::optional<velum::Length> max_edge;
  bool slivers = true;

  static auto about() {
    return velum::About<DelaunayProjected>(
               "Triangles of the cloud's projection on a plane or on the scan angles, with long "
               "edges and border slivers trimmed.")
        .in("cloud")
        .out("mesh")
        .choice(&DelaunayProjected::plane, "plane", "what the points are projected on",
                {{"auto", Plane::automatic, "best_fit, or spherical where that folds less"},
                 {"best_fit", Plane::best_fit, "the plane that fits the cloud best"},
                 {"spherical", Plane::spherical,
                  "the angles (alpha, gamma) under which the main sensor sees the points"}})
        .param(&DelaunayProjected::max_edge, "max_edge",
               "longest edge; unset: six times the spacing of the points around it",
               velum::above(0.0))
        .param(&DelaunayProjected::slivers, "trim_slivers",
               "remove the slivers that the convex hull leaves over a curved border")
        .reference("thesis 3.5.2, Algorithm 3.8")
        .reference(
            "Duckham et al., Efficient generation of simple polygons for characterizing the "
            "shape of a set of points in the plane, Pattern Recognition 41 (2008)")
        .licence("GPL-3.0-or-later");
  }

  Mesh operator()(const Cloud& cloud, Context& context) const;

 private:
  [[nodiscard]] Sheet triangulate(const Eigen::Matrix2Xd& projected, const Cloud& cloud,
                                  const velum::meshing::TrimRules& rules) const;
  [[nodiscard]] Sheet choose(const Cloud& cloud, const velum::meshing::TrimRules& rules,
                             Context& context) const;
};

/// Triangles that stand across the surface that their vertices lie on.
Index count_folds(const std::vector<Triangle>& triangles, const Cloud& cloud) {
  const auto positions = cloud.positions();
  const auto normals = cloud.normals();
  return std::count_if(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    const Eigen::Vector3d ab = (positions.col(t[1]) - positions.col(t[0])).cast<double>();
    const Eigen::Vector3d ac = (positions.col(t[2]) - positions.col(t[0])).cast<double>();
    const Eigen::Vector3d normal = ab.cross(ac).normalized();
    return std::all_of(t.begin(), t.end(), [&](std::int32_t v) {
      return std::abs(normals.col(v).cast<double>().dot(normal)) < kFoldCosine;
    });
  });
}

Sheet DelaunayProjected::triangulate(const Eigen::Matrix2Xd& projected, const Cloud& cloud,
                                     const velum::meshing::TrimRules& rules) const {
  Sheet sheet{velum::cgal::delaunay_2(projected)};
  velum::meshing::remove_long(sheet.triangles, cloud.positions(), rules);
  if (slivers) velum::meshing::peel_slivers(sheet.triangles, cloud.positions(), rules);
  sheet.folds = count_folds(sheet.triangles, cloud);
  return sheet;
}

Sheet DelaunayProjected::choose(const Cloud& cloud, const velum::meshing::TrimRules& rules,
                                Context& context) const {
  const std::optional<std::size_t> sensor = velum::meshing::main_sensor(cloud);
  if (plane == Plane::spherical && !sensor)
    throw velum::Error(velum::Fault::stage,
                       "plane = \"spherical\" needs to know where the scanner stood, and the cloud "
                       "has no sensor")
        .hint("use plane = \"best_fit\"");
  Sheet best;
  if (plane != Plane::spherical) {
    best = triangulate(velum::meshing::project_best_fit(cloud.positions()), cloud, rules);
    if (plane == Plane::best_fit || !sensor || best.fold_share() <= kFoldsAllowed) return best;
  }
  context.check();
  Sheet spherical = triangulate(
      velum::meshing::project_spherical(cloud.positions(), cloud.sensor_position(*sensor)), cloud,
      rules);
  if (plane == Plane::spherical) return spherical;
  const bool better = spherical.fold_share() < best.fold_share();
  context.info(better ? "projected on the scan angles: the best-fit plane folds"
                      : "projected on the best-fit plane: the scan angles fold more");
  return better ? spherical : best;
}

Mesh DelaunayProjected::operator()(const Cloud& input, Context& context) const {
  context.check();
  // Folds are seen against the normals of the points; without any they are estimated.
  Cloud cloud = input;
  if (!cloud.has(velum::column::kNormals) && cloud.size() > 0) {
    velum::geometry::NormalOptions options;
    options.neighbours = 16;
    cloud = cloud.with(
        velum::column::kNormals,
        velum::Column(velum::geometry::estimate_normals(cloud, options, context).normals));
  }
  velum::meshing::TrimRules rules;
  rules.spacing = velum::meshing::local_spacing(cloud, context);
  rules.max_edge = max_edge ? max_edge->value : 0.0;
  context.progress(0.3);

  Sheet sheet = cloud.size() < 3 ? Sheet{} : choose(cloud, rules, context);
  if (sheet.triangles.empty())
    context.warn(
        "no triangle: fewer than three points, points on a line, or every edge is longer "
        "than max_edge");
  velum::mesh::orient(sheet.triangles, cloud);
  Mesh mesh = velum::mesh::mesh_over(sheet.triangles, input);
  if (sheet.fold_share() > kFoldsAllowed && sheet.folds > 0)
    context.warn("the projection folds: " + std::to_string(sheet.folds) + " of " +
                 std::to_string(sheet.triangles.size()) +
                 " triangles stand across the surface; try the other plane, or smooth first");
  context.measure("triangles", static_cast<double>(mesh.size()), "");
  context.measure("folds", static_cast<double>(sheet.folds), "", velum::Better::lower);
  context.measure("unused_points", static_cast<double>(input.size() - mesh.vertices().size()), "",
                  velum::Better::lower);
  return mesh;
}

}  // namespace
VELUM_STAGE(DelaunayProjected)
