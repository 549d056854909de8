// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "sail/sheet.hpp"

#include <algorithm>

#include "mesh/topology.hpp"

namespace velum::sail {
namespace {

using Eigen::Vector3d;

Eigen::Matrix3d axes_of(const Vector3d& up, const Vector3d& bow) {
  const Vector3d z = up.normalized();
  const Vector3d forward = bow - bow.dot(z) * z;
  if (!(up.norm() > 0.0) || !(forward.norm() > 1e-6 * bow.norm()))
    throw Error(Fault::graph, "'up' and 'bow' are zero or parallel")
        .hint("up points to the masthead, bow to the front of the boat");
  Eigen::Matrix3d axes;
  axes.row(0) = -forward.normalized();
  axes.row(2) = z;
  axes.row(1) = z.cross(Vector3d(axes.row(0)));
  return axes;
}

double loop_length(const Eigen::Matrix3Xd& points, const std::vector<std::int32_t>& loop) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    sum += (points.col(loop[(i + 1) % loop.size()]) - points.col(loop[i])).norm();
  return sum;
}

double median_edge(const Eigen::Matrix3Xd& points, const std::vector<std::int32_t>& loop) {
  std::vector<double> edges;
  for (std::size_t i = 0; i < loop.size(); ++i)
    edges.push_back((points.col(loop[(i + 1) % loop.size()]) - points.col(loop[i])).norm());
  const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
  std::nth_element(edges.begin(), middle, edges.end());
  return *middle;
}

}  // namespace

Sheet make_sheet(const Mesh& mesh, const Vector3d& up, const Vector3d& bow) {
  Sheet sheet;
  sheet.mesh = mesh;
  sheet.axes = axes_of(up, bow);
  sheet.points = sheet.axes * mesh.positions().cast<double>();
  double longest = 0.0;
  for (auto& loop : mesh::border_loops(mesh.triangles(), mesh::adjacency(mesh.triangles()))) {
    const double length = loop_length(sheet.points, loop);
    if (length <= longest) continue;
    longest = length;
    sheet.loop = std::move(loop);
  }
  if (sheet.loop.size() < 8)
    throw Error(Fault::stage, "the mesh has no border of at least eight vertices, a sail has one")
        .hint("mesh one sail at a time, and trim long edges");
  sheet.spacing = median_edge(sheet.points, sheet.loop);
  if (!(sheet.spacing > 0.0))
    throw Error(Fault::stage, "most vertices of the mesh's border lie at one place");
  return sheet;
}

}  // namespace velum::sail
