// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "cad/compare.hpp"

#include <fmt/format.h>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom_Surface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>

#include <algorithm>

#include "bspline/evaluate.hpp"
#include "cad/face.hpp"

namespace velum::cad {
namespace {

/// Share by which figures may differ after a way through fifteen digits.
constexpr double kDigits = 1e-6;
/// Places of each loop that are measured.
constexpr Index kBorderSamples = 64;

Index count_wires(const TopoDS_Face& face) {
  Index count = 0;
  for (TopExp_Explorer at(face, TopAbs_WIRE); at.More(); at.Next()) ++count;
  return count;
}

double area_of(const TopoDS_Face& face) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(face, properties);
  return std::abs(properties.Mass()) / (kMillimetres * kMillimetres);
}

double border_of(const TopoDS_Face& face) {
  GProp_GProps properties;
  BRepGProp::LinearProperties(face, properties);
  return properties.Mass() / kMillimetres;
}

double surface_error(const TopoDS_Face& face, const bspline::Patch& patch) {
  const Handle(Geom_Surface) geometry = BRep_Tool::Surface(face);
  const Eigen::Vector2d low = patch.low();
  const Eigen::Vector2d size = patch.high() - low;
  constexpr int kSteps = 24;
  double worst = 0.0;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const Eigen::Vector2d share(static_cast<double>(i) / kSteps, static_cast<double>(j) / kSteps);
      const Eigen::Vector2d uv = low + share.cwiseProduct(size);
      const gp_Pnt p = geometry->Value(uv.x(), uv.y());
      const Eigen::Vector3d found = Eigen::Vector3d(p.X(), p.Y(), p.Z()) / kMillimetres;
      worst = std::max(worst, (found - patch.at(uv) - patch.surface().origin).norm());
    }
  return worst;
}

/// Edges that have a length: the library measures no distance from degenerate ones.
TopoDS_Compound edges_of(const TopoDS_Face& face) {
  BRep_Builder builder;
  TopoDS_Compound edges;
  builder.MakeCompound(edges);
  for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next())
    if (!BRep_Tool::Degenerated(TopoDS::Edge(at.Current()))) builder.Add(edges, at.Current());
  return edges;
}

double border_error(const TopoDS_Face& face, const bspline::Patch& patch) {
  const TopoDS_Compound edges = edges_of(face);
  double worst = 0.0;
  for (const Eigen::Matrix2Xd& loop : patch.surface().trimming) {
    const Index step = std::max<Index>(1, loop.cols() / kBorderSamples);
    for (Index i = 0; i < loop.cols(); i += step) {
      const Eigen::Vector3d p = kMillimetres * (patch.at(loop.col(i)) + patch.surface().origin);
      const BRepExtrema_DistShapeShape distance(
          BRepBuilderAPI_MakeVertex(gp_Pnt(p.x(), p.y(), p.z())).Vertex(), edges);
      if (!distance.IsDone())
        throw Error(Fault::output, "the border that was read back cannot be measured");
      worst = std::max(worst, distance.Value() / kMillimetres);
    }
  }
  return worst;
}

void require_equal(const char* what, double found, double expected) {
  if (std::abs(found - expected) > kDigits * std::abs(expected))
    throw Error(Fault::output,
                fmt::format("read back, the {} is {}, expected {}", what, found, expected));
}

}  // namespace

void only_face(const TopoDS_Shape& shape, TopoDS_Face& face) {
  Index count = 0;
  if (!shape.IsNull())
    for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next(), ++count)
      face = TopoDS::Face(at.Current());
  if (count != 1)
    throw Error(Fault::output,
                fmt::format("read back, the file holds {} faces, expected one", count));
}

Written compare(const TopoDS_Face& read, const TopoDS_Face& wrote, const Surface& surface,
                double tolerance) {
  const bspline::Patch patch(surface);
  Written found;
  found.loops = count_wires(read);
  if (found.loops != count_wires(wrote))
    throw Error(Fault::output, fmt::format("read back, the face has {} borders, expected {}",
                                           found.loops, count_wires(wrote)));
  const double extent =
      (surface.control.rowwise().maxCoeff() - surface.control.rowwise().minCoeff()).norm() +
      surface.origin.norm();
  constexpr double kFileDigits = 1e-11;
  found.surface_error = surface_error(read, patch);
  if (found.surface_error > 1e-8 + kFileDigits * extent)
    throw Error(Fault::output,
                fmt::format("read back, the surface is off by {} m", found.surface_error));
  found.border_error = border_error(read, patch);
  if (found.border_error > 2.0 * tolerance)
    throw Error(Fault::output,
                fmt::format("read back, a border is off by {} m", found.border_error));
  found.area = area_of(read);
  require_equal("area", found.area, area_of(wrote));
  found.border_length = border_of(read);
  require_equal("length of the borders", found.border_length, border_of(wrote));
  return found;
}

}  // namespace velum::cad
