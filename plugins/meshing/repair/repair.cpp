// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include <numbers>

#include "draft.hpp"
#include "mesh/build.hpp"
#include "refine.hpp"

namespace {

using velum::Better;
using velum::Cloud;
using velum::Context;
using velum::Index;
using velum::Mesh;
using velum::Points;
using velum::meshing::Draft;
using velum::meshing::Refined;

struct Repair {
  double min_part = 0.05;
  velum::Angle min_angle{std::numbers::pi / 180.0};
  std::optional<velum::Length> max_hole;
  std::optional<int> triangles;
  std::optional<velum::Length> max_error;
  int smooth = 0;

  static auto about() {
    return velum::About<Repair>(
               "Makes a mesh manifold and consistently oriented; drops islands and slivers, closes "
               "holes, decimates, smooths.")
        .in("mesh")
        .out("mesh")
        .param(&Repair::min_part, "min_part",
               "drop parts with less than this share of the largest one's area; 1: keep that alone",
               velum::between(0.0, 1.0))
        .param(&Repair::min_angle, "min_angle",
               "triangles with a smaller angle are slivers and are removed; 0: none",
               velum::between(0.0, std::numbers::pi / 6.0))
        .param(&Repair::max_hole, "max_hole",
               "close holes whose border is at most so long; unset: none", velum::above(0.0))
        .param(&Repair::triangles, "triangles", "decimate to this many", velum::at_least(1))
        .param(&Repair::max_error, "max_error",
               "decimate while every removed vertex stays this near to the mesh", velum::above(0.0))
        .param(&Repair::smooth, "smooth", "rounds of Laplacian smoothing; borders stay",
               velum::between(0, 1000))
        .reference("OpenMesh 9 (Botsch et al., OpenMesh, OpenSG Symposium 2002)")
        .reference(
            "Garland and Heckbert, Surface simplification using quadric error metrics, SIGGRAPH "
            "1997")
        .reference(
            "Barequet and Sharir, Filling gaps in the boundary of a polyhedron, Computer Aided "
            "Geometric Design 12 (1995)");
  }

  Mesh operator()(const Mesh& mesh, Context& context) const;

 private:
  void refine(Draft& draft, Context& context) const;
};

/// Manifold and consistently oriented from here on.
void untangle(Draft& draft, const Cloud& vertices, Context& context) {
  const auto before = static_cast<double>(draft.triangles.size());
  velum::meshing::drop_doubles(draft);
  Index split = velum::meshing::split_non_manifold(draft);
  // Twins look at the same sensor as the vertex they come from.
  const Cloud seen = vertices.select(draft.source);
  const velum::mesh::Orientation turned = velum::mesh::orient(draft.triangles, seen);
  if (turned.conflicts > 0) split += velum::meshing::split_conflicts(draft);
  context.measure("triangles_dropped", before - static_cast<double>(draft.triangles.size()), "");
  context.measure("vertices_split", static_cast<double>(split), "");
  context.measure("triangles_turned", static_cast<double>(turned.turned), "");
}

void warn_refused(const Refined& done, Context& context) {
  if (done.refused > 0)
    context.warn(std::to_string(done.refused) +
                 " triangles do not fit into a manifold mesh and were dropped");
}

void Repair::refine(Draft& draft, Context& context) const {
  velum::meshing::RefineRules rules;
  rules.min_angle = min_angle;
  if (triangles) rules.target = *triangles;
  if (max_error) rules.max_error = max_error->value;
  rules.smooth = smooth;
  Index slivers = 0;
  if (min_angle > 0.0) {
    const Refined done = velum::meshing::remove_slivers(draft, rules, context);
    warn_refused(done, context);
    slivers = done.slivers;
  }
  context.progress(0.5);
  velum::meshing::Closed closed;
  if (max_hole) closed = velum::meshing::close_holes(draft, *max_hole);
  if (closed.left_open > 0)
    context.warn(std::to_string(closed.left_open) +
                 " holes stay open: more than 400 vertices, or no triangles fit in");
  context.check();
  context.progress(0.7);
  if (triangles || max_error || smooth > 0)
    warn_refused(velum::meshing::decimate_and_smooth(draft, rules, context), context);
  context.measure("slivers_removed", static_cast<double>(slivers), "");
  context.measure("holes_closed", static_cast<double>(closed.holes), "");
}

/// Normals of the vertices by the triangles around them; a vertex without area keeps what it had.
Points normals_by_triangles(const Draft& draft, const Cloud& vertices) {
  Eigen::Matrix3Xd sums = Eigen::Matrix3Xd::Zero(3, vertices.size());
  const velum::ConstPoints positions = vertices.positions();
  for (const velum::mesh::Triangle& t : draft.triangles) {
    const Eigen::Vector3d area = velum::mesh::area_vector(t, positions);
    for (const std::int32_t v : t) sums.col(v) += area;
  }
  Points normals = vertices.normals();
  for (Index v = 0; v < normals.cols(); ++v)
    if (sums.col(v).norm() > 0.0) normals.col(v) = sums.col(v).normalized().cast<float>();
  return normals;
}

Mesh Repair::operator()(const Mesh& mesh, Context& context) const {
  context.check();
  Draft draft(mesh);
  untangle(draft, mesh.vertices(), context);
  const Points places =
      draft.positions.leftCols(static_cast<Index>(draft.source.size())).cast<float>();
  const Index islands = velum::mesh::keep_parts(
      draft.triangles, velum::ConstPoints(places.data(), 3, places.cols()), min_part);
  context.check();
  refine(draft, context);
  if (draft.triangles.empty()) context.warn("no triangle is left");

  Cloud vertices =
      mesh.vertices()
          .select(draft.source)
          .with_positions(
              draft.positions.leftCols(static_cast<Index>(draft.source.size())).cast<float>());
  if (smooth > 0 && vertices.has(velum::column::kNormals))
    vertices = vertices.with(velum::column::kNormals,
                             velum::Column(normals_by_triangles(draft, vertices)));
  Mesh repaired = velum::mesh::mesh_over(draft.triangles, vertices);
  context.measure("islands_dropped", static_cast<double>(islands), "");
  context.measure("triangles", static_cast<double>(repaired.size()), "");
  return repaired;
}

}  // namespace
VELUM_STAGE(Repair)
