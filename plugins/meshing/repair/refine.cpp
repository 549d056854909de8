// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "refine.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModHausdorffT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace velum::meshing {
namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
  FaceAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::Status);
};
using Sheet = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Half = Sheet::HalfedgeHandle;
using Face = Sheet::FaceHandle;
using Vertex = Sheet::VertexHandle;

constexpr double kFlat = 150.0 * std::numbers::pi / 180.0;  // angle of a cap
constexpr int kMostRounds = 10;

/// The draft as OpenMesh holds it, and back. Vertices keep their numbers while it is worked on.
class Work {
 public:
  explicit Work(const Draft& draft) {
    for (std::size_t v = 0; v < draft.source.size(); ++v) {
      const Eigen::Vector3d p = draft.positions.col(static_cast<Index>(v));
      sheet.add_vertex({p.x(), p.y(), p.z()});
    }
    // What it cannot add it would complain of on the console.
    omerr().disable();
    for (const mesh::Triangle& t : draft.triangles)
      if (!sheet.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])).is_valid()) ++refused;
  }
  void store(Draft& draft) const {
    draft.triangles.clear();
    for (const Face face : sheet.faces()) {
      mesh::Triangle t{};
      std::size_t i = 0;
      for (const Vertex v : sheet.fv_range(face)) t[i++] = v.idx();
      draft.triangles.push_back(t);
    }
    for (const Vertex v : sheet.vertices()) {
      const Sheet::Point& p = sheet.point(v);
      draft.positions.col(v.idx()) << p[0], p[1], p[2];
    }
  }

  Sheet sheet;
  Index refused = 0;
};

/// A triangle's smallest and largest angle, with the halfedges opposite to them.
struct Corners {
  double least = std::numbers::pi;
  double most = 0.0;
  Half shortest, longest;
};

Corners corners_of(const Sheet& sheet, Face face) {
  Corners found;
  double shortest = std::numeric_limits<double>::max();
  double longest = -1.0;
  for (const Half h : sheet.fh_range(face)) {
    const Sheet::Point a = sheet.point(sheet.to_vertex_handle(sheet.next_halfedge_handle(h)));
    const Sheet::Point u = sheet.point(sheet.from_vertex_handle(h)) - a;
    const Sheet::Point v = sheet.point(sheet.to_vertex_handle(h)) - a;
    const double angle = std::atan2(u.cross(v).norm(), u.dot(v));
    const double length = (u - v).norm();
    found.least = std::min(found.least, angle);
    found.most = std::max(found.most, angle);
    if (length < shortest) {
      shortest = length;
      found.shortest = h;
    }
    if (length > longest) {
      longest = length;
      found.longest = h;
    }
  }
  return found;
}

double least_angle(const Sheet::Point& a, const Sheet::Point& b, const Sheet::Point& c) {
  const auto angle = [](const Sheet::Point& u, const Sheet::Point& v) {
    return std::atan2(u.cross(v).norm(), u.dot(v));
  };
  return std::min({angle(b - a, c - a), angle(a - b, c - b), angle(a - c, b - c)});
}

/// Turns the edge of both triangles at `h` when their smallest angle gains and none folds over.
bool flip(Sheet& sheet, Half h) {
  const auto edge = sheet.edge_handle(h);
  if (sheet.is_boundary(edge) || !sheet.is_flip_ok(edge)) return false;
  const Half back = sheet.opposite_halfedge_handle(h);
  const Sheet::Point a = sheet.point(sheet.from_vertex_handle(h));
  const Sheet::Point b = sheet.point(sheet.to_vertex_handle(h));
  const Sheet::Point c = sheet.point(sheet.to_vertex_handle(sheet.next_halfedge_handle(h)));
  const Sheet::Point d = sheet.point(sheet.to_vertex_handle(sheet.next_halfedge_handle(back)));
  const double before = std::min(least_angle(a, b, c), least_angle(b, a, d));
  const double after = std::min(least_angle(c, d, b), least_angle(d, c, a));
  const bool folds = (d - c).cross(b - c).dot((c - d).cross(a - d)) < 0.0;
  if (after <= before || folds) return false;
  sheet.flip(edge);
  return true;
}

/// Would a triangle around the first vertex turn over if it moved into the second?
bool turns_over(const Sheet& sheet, Half h) {
  const Vertex from = sheet.from_vertex_handle(h);
  const Vertex to = sheet.to_vertex_handle(h);
  for (const Half out : sheet.voh_range(from)) {
    if (sheet.is_boundary(out)) continue;
    const Vertex b = sheet.to_vertex_handle(out);
    const Vertex c = sheet.to_vertex_handle(sheet.next_halfedge_handle(out));
    if (b == to || c == to) continue;
    const Sheet::Point was =
        (sheet.point(b) - sheet.point(from)).cross(sheet.point(c) - sheet.point(from));
    const Sheet::Point is =
        (sheet.point(b) - sheet.point(to)).cross(sheet.point(c) - sheet.point(to));
    constexpr double kTurned = 0.2;
    if (was.norm() > 0.0 && is.dot(was) < kTurned * is.norm() * was.norm()) return true;
  }
  return false;
}

/// Moves one end of the edge into the other: an inner vertex into one of the border, if it can.
bool collapse(Sheet& sheet, Half h) {
  const bool on_border = sheet.is_boundary(sheet.edge_handle(h));
  for (const Half way : {h, sheet.opposite_halfedge_handle(h)}) {
    if (sheet.is_boundary(sheet.from_vertex_handle(way)) && !on_border) continue;
    if (!sheet.is_collapse_ok(way) || turns_over(sheet, way)) continue;
    sheet.collapse(way);
    return true;
  }
  return false;
}

bool cure(Sheet& sheet, Face face, double min_angle) {
  const Corners corners = corners_of(sheet, face);
  if (corners.least >= min_angle) return false;
  if (corners.most < kFlat) return collapse(sheet, corners.shortest);
  if (flip(sheet, corners.longest)) return true;
  if (sheet.is_boundary(sheet.edge_handle(corners.longest))) {
    sheet.delete_face(face, false);
    return true;
  }
  return collapse(sheet, corners.shortest);
}

void decimate(Sheet& sheet, const RefineRules& rules) {
  for (const Vertex v : sheet.vertices())
    if (sheet.is_boundary(v)) sheet.status(v).set_locked(true);
  OpenMesh::Decimater::DecimaterT<Sheet> decimater(sheet);
  OpenMesh::Decimater::ModQuadricT<Sheet>::Handle quadric;
  OpenMesh::Decimater::ModNormalFlippingT<Sheet>::Handle flipping;
  OpenMesh::Decimater::ModHausdorffT<Sheet>::Handle distance;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();
  decimater.add(flipping);
  constexpr double kMostTurn = 30.0;  // degrees
  decimater.module(flipping).set_max_normal_deviation(kMostTurn);
  if (rules.max_error) {
    decimater.add(distance);
    decimater.module(distance).set_tolerance(*rules.max_error);
  }
  if (!decimater.initialize()) throw Error(Fault::stage, "OpenMesh cannot decimate the mesh");
  decimater.decimate_to_faces(0, static_cast<std::size_t>(rules.target.value_or(0)));
}

void smooth(Sheet& sheet, int rounds, Context& context) {
  using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<Sheet>;
  Smoother smoother(sheet);
  smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C1);
  for (int i = 0; i < rounds; ++i) {
    smoother.smooth(1);
    context.check();
  }
}

}  // namespace

Refined remove_slivers(Draft& draft, const RefineRules& rules, Context& context) {
  Work work(draft);
  Refined done;
  done.refused = work.refused;
  Sheet& sheet = work.sheet;
  for (int round = 0; round < kMostRounds; ++round) {
    context.check();
    Index cured = 0;
    for (std::size_t i = 0; i < sheet.n_faces(); ++i) {
      const Face face(static_cast<int>(i));
      if (!sheet.status(face).deleted() && cure(sheet, face, rules.min_angle)) ++cured;
    }
    done.slivers += cured;
    if (cured == 0) break;
  }
  work.store(draft);
  return done;
}

Refined decimate_and_smooth(Draft& draft, const RefineRules& rules, Context& context) {
  Work work(draft);
  Refined done;
  done.refused = work.refused;
  work.sheet.update_normals();
  if (rules.target || rules.max_error) decimate(work.sheet, rules);
  context.check();
  if (rules.smooth > 0) smooth(work.sheet, rules.smooth, context);
  work.store(draft);
  return done;
}

}  // namespace velum::meshing
