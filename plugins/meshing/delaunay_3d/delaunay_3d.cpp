// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include <algorithm>

#include "cgal/delaunay_3.hpp"
#include "mesh/build.hpp"

namespace {

using velum::Better;
using velum::Cloud;
using velum::Context;
using velum::Mesh;
using velum::cgal::Delaunay3;
using velum::mesh::Triangle;

enum class Faces { all, seen };

struct Delaunay3d {
  velum::Length max_edge = velum::spacings(4);
  Faces faces = Faces::all;

  static auto about() {
    return velum::About<Delaunay3d>(
               "Faces of the cloud's Delaunay tetrahedra that have no long edge.")
        .in("cloud")
        .out("mesh")
        .param(&Delaunay3d::max_edge, "max_edge", "faces with a longer edge are removed",
               velum::above(0.0))
        .choice(&Delaunay3d::faces, "faces", "which of the faces with short edges are kept",
                {{"all", Faces::all, "every one, also inside flat tetrahedra: not manifold"},
                 {"seen", Faces::seen,
                  "those that no tetrahedron with short edges hides from its sensor"}})
        .reference("thesis 3.5.2, Algorithm 3.7 and figure 3.69")
        .reference("The CGAL project, 3D Triangulations (Delaunay_triangulation_3)")
        .licence("GPL-3.0-or-later");
  }

  Mesh operator()(const Cloud& cloud, Context& context) const;

 private:
  [[nodiscard]] std::vector<Triangle> short_faces(const Delaunay3& delaunay,
                                                  const Cloud& cloud) const;
};

/// Decides by edges, whose lengths are compared squared.
class Shortness {
 public:
  Shortness(const Cloud& cloud, double max_edge)
      : positions_(cloud.positions()), most_(max_edge * max_edge) {}

  template <std::size_t N>
  [[nodiscard]] bool operator()(const std::array<std::int32_t, N>& corners) const {
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = i + 1; j < N; ++j)
        if ((at(corners[i]) - at(corners[j])).squaredNorm() > most_) return false;
    return true;
  }

 private:
  [[nodiscard]] Eigen::Vector3d at(std::int32_t point) const {
    return positions_.col(point).cast<double>();
  }

  velum::ConstPoints positions_;
  double most_;
};

Triangle face_of(const std::array<std::int32_t, 4>& cell, std::size_t opposite) {
  Triangle t{};
  std::size_t n = 0;
  for (std::size_t i = 0; i < 4; ++i)
    if (i != opposite) t[n++] = cell[i];
  return t;
}

/// Does the sensor of the face lie on the side of `point`?
bool sensor_side(const Triangle& face, std::int32_t point, const Cloud& cloud) {
  const auto positions = cloud.positions();
  const Eigen::Vector3d normal = velum::mesh::area_vector(face, positions);
  const Eigen::Vector3d at = positions.col(face[0]).cast<double>();
  const Eigen::Vector3d sensor =
      cloud.sensor_position(cloud.sensor_of(face[0]).value()).cast<double>();
  return normal.dot(sensor - at) * normal.dot(positions.col(point).cast<double>() - at) > 0.0;
}

std::vector<Triangle> Delaunay3d::short_faces(const Delaunay3& delaunay, const Cloud& cloud) const {
  const Shortness is_short(cloud, max_edge);
  std::vector<Triangle> kept;
  for (const Triangle& t : delaunay.flat)
    if (is_short(t)) kept.push_back(t);
  std::vector<char> full(delaunay.cells.size(), 0);  // cells with short edges only
  for (std::size_t c = 0; c < full.size(); ++c) full[c] = is_short(delaunay.cells[c]) ? 1 : 0;
  for (std::size_t c = 0; c < full.size(); ++c) {
    for (std::size_t i = 0; i < 4; ++i) {
      const std::int32_t other = delaunay.across[c][i];
      if (other > static_cast<std::int32_t>(c)) continue;  // met from there
      const Triangle t = face_of(delaunay.cells[c], i);
      if (!is_short(t)) continue;
      if (faces == Faces::seen) {
        const bool here = full[c] != 0;
        const bool there = other >= 0 && full[static_cast<std::size_t>(other)] != 0;
        if (here && there) continue;
        if (here != there && sensor_side(t, delaunay.cells[c][i], cloud) == here) continue;
      }
      kept.push_back(t);
    }
  }
  for (Triangle& t : kept) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(kept.begin(), kept.end());
  return kept;
}

Mesh Delaunay3d::operator()(const Cloud& cloud, Context& context) const {
  context.check();
  if (faces == Faces::seen && cloud.sensors().empty() && !cloud.empty())
    throw velum::Error(velum::Fault::stage,
                       "faces = \"seen\" needs to know where the scanner stood, and the cloud has "
                       "no sensor")
        .hint("use faces = \"all\"");
  std::vector<Triangle> triangles;
  if (cloud.size() >= 3) {
    const Delaunay3 delaunay = velum::cgal::delaunay_3(cloud.positions().cast<double>());
    context.check();
    context.progress(0.7);
    triangles = short_faces(delaunay, cloud);
    context.measure("tetrahedra", static_cast<double>(delaunay.cells.size()), "");
  }
  velum::mesh::orient(triangles, cloud);
  if (triangles.empty())
    context.warn(
        "no triangle: fewer than three points, points on a line, or every edge is longer than "
        "max_edge");
  const velum::Index crossed =
      velum::mesh::adjacency(velum::mesh::view(triangles)).non_manifold_edges;
  if (crossed > 0)
    context.warn(std::to_string(crossed) +
                 " edges have more than two triangles: this is no surface; " +
                 (faces == Faces::all ? "try faces = \"seen\", or another mesher"
                                      : "smooth the cloud first, or use another mesher"));
  Mesh mesh = velum::mesh::mesh_over(triangles, cloud);
  context.measure("triangles", static_cast<double>(mesh.size()), "");
  context.measure("non_manifold_edges", static_cast<double>(crossed), "", Better::lower);
  context.measure("unused_points", static_cast<double>(cloud.size() - mesh.vertices().size()), "",
                  Better::lower);
  return mesh;
}

}  // namespace
VELUM_STAGE(Delaunay3d)
