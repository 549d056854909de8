// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "sail/sheet.hpp"

#include "mesh/topology.hpp"

namespace velum::sail {
namespace {

using Eigen::Vector3d;

double loop_length(const Eigen::Matrix3Xd& points, const std::vector<std::int32_t>& loop) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    sum += (points.col(loop[(i + 1) % loop.size()]) - points.col(loop[i])).norm();
  return sum;
}

}  // namespace

Eigen::Matrix3Xd Sheet::border() const {
  Eigen::Matrix3Xd polygon(3, static_cast<Index>(loop.size()));
  for (Index i = 0; i < polygon.cols(); ++i)
    polygon.col(i) = points.col(loop[static_cast<std::size_t>(i)]);
  return polygon;
}

Sheet make_sheet(const Mesh& mesh, const Vector3d& up, const Vector3d& bow) {
  Sheet sheet;
  sheet.mesh = mesh;
  sheet.frame = make_frame(up, bow, mesh.origin());
  sheet.points = sheet.frame.axes * mesh.positions().cast<double>();
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
  sheet.spacing = median_edge(sheet.border());
  if (!(sheet.spacing > 0.0))
    throw Error(Fault::stage, "most vertices of the mesh's border lie at one place");
  return sheet;
}

}  // namespace velum::sail
