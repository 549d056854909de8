// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "mesh/build.hpp"
#include "reconstruct.hpp"
#include "trim.hpp"

namespace {

using velum::Better;
using velum::Cloud;
using velum::Context;
using velum::Index;
using velum::Mesh;
using velum::Points;
using velum::mesh::Triangle;
using velum::meshing::Draft;

/// Fewer points than this give the solver nothing to hold on to.
constexpr Index kFewestPoints = 10;

struct Poisson {
  int depth = 8;
  double scale = 1.1;
  std::optional<int> solver_divide;
  std::optional<int> iso_divide;
  double samples_per_node = 1.0;
  double point_weight = 4.0;
  std::optional<velum::Length> max_distance;
  double min_density = 0.7;
  bool largest_part = true;

  static auto about() {
    return velum::About<Poisson>(
               "PCL's Poisson reconstruction: the border of a solid whose gradient is the normals, "
               "trimmed to where there are points.")
        .in("cloud")
        .needs("cloud", "normals")
        .out("mesh")
        .adds("mesh", "normals")
        .drops_columns()
        .param(&Poisson::depth, "depth", "of the octree: its cells are the cube / 2^depth",
               velum::between(3, 12))
        .param(&Poisson::scale, "scale", "edge of the cube, of the cloud's longest side",
               velum::between(1.0, 4.0))
        .param(&Poisson::solver_divide, "solver_divide",
               "depth from which the equation is solved by blocks; unset: depth",
               velum::between(1, 12))
        .advanced()
        .param(&Poisson::iso_divide, "iso_divide",
               "depth from which the surface is extracted by blocks; unset: depth",
               velum::between(1, 12))
        .advanced()
        .param(&Poisson::samples_per_node, "samples_per_node",
               "least points in a cell: up to 5 for clean points, 15 to 20 for noisy ones",
               velum::between(1.0, 100.0))
        .param(&Poisson::point_weight, "point_weight",
               "how hard the surface is drawn to the points; 0: by the normals alone",
               velum::at_least(0.0))
        .param(&Poisson::max_distance, "max_distance",
               "trim what is farther from the nearest point", velum::above(0.0))
        .param(
            &Poisson::min_density, "min_density",
            "trim where the density of points is less than this share of the usual one at the same "
            "points: about 0.7 at a border; 0: do not",
            velum::between(0.0, 1.0))
        .param(&Poisson::largest_part, "largest_part", "keep the largest part, drop the others")
        .isolated()
        .reference("thesis 3.5.3, table 3.33 and figure 3.75")
        .reference(
            "Kazhdan and Hoppe, Screened Poisson surface reconstruction, ACM Transactions on "
            "Graphics 32 (2013)");
  }

  void check() const;
  Mesh operator()(const Cloud& cloud, Context& context) const;

 private:
  [[nodiscard]] velum::meshing::PoissonRules rules() const;
  [[nodiscard]] Draft trimmed(Draft draft, const Cloud& cloud, Context& context) const;
};

void Poisson::check() const {
  for (const auto& [name, divide] :
       {std::pair("solver_divide", solver_divide), std::pair("iso_divide", iso_divide)})
    if (divide.value_or(depth) > depth)
      throw velum::Error(velum::Fault::graph, std::string(name) + " is " + std::to_string(*divide) +
                                                  ", expected at most depth, which is " +
                                                  std::to_string(depth))
          .at(name);
}

velum::meshing::PoissonRules Poisson::rules() const {
  velum::meshing::PoissonRules rules;
  rules.depth = depth;
  rules.solver_divide = solver_divide.value_or(depth);
  rules.iso_divide = iso_divide.value_or(depth);
  rules.scale = scale;
  rules.samples_per_node = samples_per_node;
  rules.point_weight = point_weight;
  return rules;
}

/// Points with a normal of length one; the library divides by it.
Cloud with_sound_normals(const Cloud& cloud) {
  const auto normals = cloud.normals();
  std::vector<std::int32_t> sound;
  for (std::int32_t i = 0; i < cloud.size(); ++i)
    if (std::abs(normals.col(i).norm() - 1.0F) < 1e-3F) sound.push_back(i);
  return cloud.select(sound);
}

Points vertex_normals(const Draft& draft) {
  const velum::ConstPoints positions(draft.positions.data(), 3, draft.positions.cols());
  Eigen::Matrix3Xd sums = Eigen::Matrix3Xd::Zero(3, positions.cols());
  for (const Triangle& t : draft.triangles) {
    const Eigen::Vector3d area = velum::mesh::area_vector(t, positions);
    for (const std::int32_t v : t) sums.col(v) += area;
  }
  for (Index v = 0; v < sums.cols(); ++v) {
    const double length = sums.col(v).norm();
    sums.col(v) = length > 0.0 ? Eigen::Vector3d(sums.col(v) / length) : Eigen::Vector3d::UnitZ();
  }
  return sums.cast<float>();
}

/// Turns all triangles so that most of them agree with the normals of the points next to them.
void face_normals(Draft& draft, const Cloud& cloud) {
  const Points normals = vertex_normals(draft);
  const auto given = cloud.normals();
  double agreement = 0.0;
  for (Index v = 0; v < normals.cols(); ++v) {
    const velum::Neighbour near =
        cloud.neighbours().nearest_one(draft.positions.col(v), std::numeric_limits<double>::max());
    if (near.index >= 0) agreement += normals.col(v).dot(given.col(near.index));
  }
  if (agreement < 0.0)
    for (Triangle& t : draft.triangles) std::swap(t[1], t[2]);
}

Draft Poisson::trimmed(Draft draft, const Cloud& cloud, Context& context) const {
  velum::meshing::Support support;
  support.max_distance = max_distance ? max_distance->value : 0.0;
  support.min_density = min_density;
  velum::meshing::cut(draft, velum::meshing::margins(draft.positions, cloud, support, context));
  if (largest_part) {
    const velum::ConstPoints positions(draft.positions.data(), 3, draft.positions.cols());
    const Index dropped = velum::mesh::keep_parts(draft.triangles, positions, 1.0);
    context.measure("parts_dropped", static_cast<double>(dropped), "", Better::lower);
  }
  return draft;
}

Mesh Poisson::operator()(const Cloud& input, Context& context) const {
  context.check();
  const velum::meshing::PoissonRules chosen = rules();
  const Cloud cloud = with_sound_normals(input);
  if (cloud.size() < input.size())
    context.warn(std::to_string(input.size() - cloud.size()) +
                 " points are not used: their normals have no length of one");
  Draft draft;
  if (cloud.size() >= kFewestPoints && cloud.spacing() > 0.0 && cloud.diagonal() > 0.0) {
    draft = velum::meshing::poisson_surface(cloud, chosen);
    context.check();
    context.progress(0.8);
    context.measure("triangles_untrimmed", static_cast<double>(draft.triangles.size()), "");
    if (!draft.triangles.empty()) draft = trimmed(std::move(draft), cloud, context);
    face_normals(draft, cloud);
  }
  if (draft.triangles.empty())
    context.warn("no triangle: fewer than ten points at different places, or all were trimmed");
  const Points normals = vertex_normals(draft);
  const Cloud vertices = Cloud(std::move(draft.positions), input.origin())
                             .with(velum::column::kNormals, velum::Column(normals))
                             .with_sensors(input.sensors());
  Mesh mesh = velum::mesh::mesh_over(draft.triangles, vertices);
  context.measure("triangles", static_cast<double>(mesh.size()), "");
  return mesh;
}

}  // namespace
VELUM_STAGE(Poisson)
