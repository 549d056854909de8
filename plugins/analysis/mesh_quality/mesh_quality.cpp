// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include <array>
#include <numbers>

#include "mesh/topology.hpp"

namespace {

using velum::Better;
using velum::Cell;
using velum::Context;
using velum::Index;
using velum::Mesh;
using velum::Table;

constexpr int kBins = 18;  // of 10° each

/// Angles and edges of all triangles.
struct Shape {
  double min_angle = std::numbers::pi;
  double sum_min_angle = 0.0;
  double worst_ratio = 1.0;
  double sum_ratio = 0.0;
  double area = 0.0;
  Index degenerate = 0;
  std::array<Index, kBins> histogram{};
};

/// The angles of a triangle by its corners [rad]; zero where edges have no length.
std::array<double, 3> angles(const std::array<Eigen::Vector3d, 3>& corner) {
  std::array<double, 3> found{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d a = corner[(i + 1) % 3] - corner[i];
    const Eigen::Vector3d b = corner[(i + 2) % 3] - corner[i];
    found[i] = std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return found;
}

Shape shape_of(const Mesh& mesh) {
  Shape shape;
  const auto positions = mesh.positions();
  const auto triangles = mesh.triangles();
  for (Index t = 0; t < triangles.cols(); ++t) {
    std::array<Eigen::Vector3d, 3> corner;
    for (int i = 0; i < 3; ++i)
      corner[static_cast<std::size_t>(i)] = positions.col(triangles(i, t)).cast<double>();
    const Eigen::Vector3d edges((corner[1] - corner[0]).norm(), (corner[2] - corner[1]).norm(),
                                (corner[0] - corner[2]).norm());
    const double area = 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
    shape.area += area;
    if (area <= 1e-12 * edges.squaredNorm()) {
      ++shape.degenerate;
      shape.min_angle = 0.0;
      continue;
    }
    const std::array<double, 3> found = angles(corner);
    const double smallest = std::min({found[0], found[1], found[2]});
    shape.min_angle = std::min(shape.min_angle, smallest);
    shape.sum_min_angle += smallest;
    const double ratio = edges.maxCoeff() / edges.minCoeff();
    shape.worst_ratio = std::max(shape.worst_ratio, ratio);
    shape.sum_ratio += ratio;
    for (const double angle : found)
      ++shape.histogram[static_cast<std::size_t>(
          std::clamp(static_cast<int>(angle / std::numbers::pi * kBins), 0, kBins - 1))];
  }
  return shape;
}

struct MeshQuality {
  static auto about() {
    return velum::About<MeshQuality>(
               "Angles, edge ratios, borders and holes of a mesh, and whether it is manifold.")
        .in("mesh")
        .out("table", "border loops with their lengths, longest first")
        .out("angles", "histogram of the triangles' angles")
        .reference("thesis 3.5.2, tables of triangle quality");
  }

  std::tuple<Table, Table> operator()(const Mesh& mesh, Context& context) const;
};

/// Outer border and holes: in each part of the mesh the longest loop is its border, all others are
/// holes.
Index count_holes(const Mesh& mesh, const velum::mesh::Adjacency& adjacency,
                  const std::vector<std::vector<std::int32_t>>& loops) {
  const velum::mesh::Components parts = velum::mesh::components(adjacency);
  std::vector<std::int32_t> part_of(static_cast<std::size_t>(mesh.vertices().size()), -1);
  const auto triangles = mesh.triangles();
  for (Index t = 0; t < triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      part_of[static_cast<std::size_t>(triangles(i, t))] = parts.of[static_cast<std::size_t>(t)];
  std::vector<Index> borders(static_cast<std::size_t>(parts.count), 0);
  for (const auto& loop : loops)
    ++borders[static_cast<std::size_t>(part_of[static_cast<std::size_t>(loop.front())])];
  Index holes = 0;
  for (const Index n : borders) holes += std::max<Index>(n - 1, 0);
  return holes;
}

std::tuple<Table, Table> MeshQuality::operator()(const Mesh& mesh, Context& context) const {
  context.check();
  const velum::mesh::Adjacency adjacency = velum::mesh::adjacency(mesh.triangles());
  const auto loops = velum::mesh::border_loops(mesh.triangles(), adjacency);
  const Index pinched = velum::mesh::pinched_vertices(mesh.triangles(), adjacency);
  context.check();
  const Shape shape = shape_of(mesh);

  std::vector<std::pair<double, std::size_t>> lengths;
  double border = 0.0;
  for (const auto& loop : loops) {
    lengths.emplace_back(velum::mesh::loop_length(mesh.positions(), loop), loop.size());
    border += lengths.back().first;
  }
  std::stable_sort(lengths.begin(), lengths.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  Table borders({{"loop", ""}, {"length", "m"}, {"vertices", ""}});
  for (std::size_t i = 0; i < lengths.size(); ++i)
    borders.add({static_cast<std::int64_t>(i), lengths[i].first,
                 static_cast<std::int64_t>(lengths[i].second)});
  Table histogram({{"from", "deg"}, {"to", "deg"}, {"angles", ""}});
  for (int bin = 0; bin < kBins; ++bin)
    histogram.add({180.0 / kBins * bin, 180.0 / kBins * (bin + 1),
                   static_cast<std::int64_t>(shape.histogram[static_cast<std::size_t>(bin)])});

  const auto count = static_cast<double>(std::max<Index>(mesh.size() - shape.degenerate, 1));
  const bool manifold = adjacency.non_manifold_edges == 0 && pinched == 0;
  context.measure("triangles", static_cast<double>(mesh.size()), "");
  context.measure("vertices", static_cast<double>(mesh.vertices().size()), "");
  context.measure("area", shape.area, "m^2");
  context.measure("parts", velum::mesh::components(adjacency).count, "", Better::lower);
  context.measure("loops", static_cast<double>(loops.size()), "", Better::lower);
  context.measure("holes", static_cast<double>(count_holes(mesh, adjacency, loops)), "",
                  Better::lower);
  context.measure("border_length", border, "m");
  context.measure("manifold", manifold ? 1.0 : 0.0, "", Better::higher);
  context.measure("non_manifold_edges", static_cast<double>(adjacency.non_manifold_edges), "",
                  Better::lower);
  context.measure("pinched_vertices", static_cast<double>(pinched), "", Better::lower);
  context.measure("degenerate", static_cast<double>(shape.degenerate), "", Better::lower);
  context.measure("min_angle", mesh.empty() ? 0.0 : shape.min_angle, "rad", Better::higher);
  context.measure("mean_min_angle", shape.sum_min_angle / count, "rad", Better::higher);
  context.measure("edge_ratio", shape.sum_ratio / count, "", Better::lower);
  context.measure("worst_edge_ratio", shape.worst_ratio, "", Better::lower);
  return {std::move(borders), std::move(histogram)};
}

}  // namespace
VELUM_STAGE(MeshQuality)
