// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "cad/face.hpp"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <Geom2dAPI_Interpolate.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TColgp_HArray1OfPnt2d.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>

#include "cad/pieces.hpp"

namespace velum::cad {
namespace {

using bspline::Patch;

/// Distinct knots with their multiplicities.
struct Knots {
  TColStd_Array1OfReal values;
  TColStd_Array1OfInteger counts;
};

Knots knots_of(const Eigen::VectorXd& all) {
  int distinct = 0;
  for (Index i = 0; i < all.size(); ++i) distinct += i == 0 || all[i] != all[i - 1] ? 1 : 0;
  Knots knots{TColStd_Array1OfReal(1, distinct), TColStd_Array1OfInteger(1, distinct)};
  int last = 0;
  for (Index i = 0; i < all.size(); ++i) {
    if (i == 0 || all[i] != all[i - 1]) {
      knots.values(++last) = all[i];
      knots.counts(last) = 0;
    }
    ++knots.counts(last);
  }
  return knots;
}

gp_Pnt millimetres(const Eigen::Vector3d& place) {
  const Eigen::Vector3d p = kMillimetres * place;
  return {p.x(), p.y(), p.z()};
}

Handle(Geom_BSplineSurface) geometry_of(const Patch& patch) {
  const Surface& surface = patch.surface();
  const auto rows = static_cast<int>(patch.count_u());
  const auto columns = static_cast<int>(patch.count_v());
  TColgp_Array2OfPnt poles(1, rows, 1, columns);
  TColStd_Array2OfReal weights(1, rows, 1, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const Index k = i * patch.count_v() + j;
      poles(i + 1, j + 1) = millimetres(surface.control.col(k) + surface.origin);
      weights(i + 1, j + 1) = surface.weights.size() == 0 ? 1.0 : surface.weights[k];
    }
  const Knots u = knots_of(surface.knots_u);
  const Knots v = knots_of(surface.knots_v);
  if (surface.weights.size() == 0)
    return new Geom_BSplineSurface(poles, u.values, v.values, u.counts, v.counts, surface.degree_u,
                                   surface.degree_v);
  return new Geom_BSplineSurface(poles, weights, u.values, v.values, u.counts, v.counts,
                                 surface.degree_u, surface.degree_v);
}

Handle(Geom2d_BSplineCurve) curve_through(const Eigen::Matrix2Xd& uv) {
  const Handle(TColgp_HArray1OfPnt2d) points =
      new TColgp_HArray1OfPnt2d(1, static_cast<int>(uv.cols()));
  for (Index i = 0; i < uv.cols(); ++i)
    points->SetValue(static_cast<int>(i) + 1, gp_Pnt2d(uv(0, i), uv(1, i)));
  constexpr double kSame = 1e-12;
  Geom2dAPI_Interpolate interpolation(points, Standard_False, kSame);
  interpolation.Perform();
  if (!interpolation.IsDone())
    throw Error(Fault::stage, "no curve can be laid through a trimming loop's points");
  return interpolation.Curve();
}

TopoDS_Edge edge_of(const Piece& piece, const Handle(Geom_BSplineSurface) & geometry,
                    const TopoDS_Vertex& from, const TopoDS_Vertex& to) {
  const Handle(Geom2d_BSplineCurve) curve = curve_through(piece.uv);
  if (piece.pole) {
    BRep_Builder builder;
    TopoDS_Edge edge;
    builder.MakeEdge(edge);
    builder.UpdateEdge(edge, curve, geometry, TopLoc_Location(), Precision::Confusion());
    builder.Range(edge, curve->FirstParameter(), curve->LastParameter());
    builder.Add(edge, from.Oriented(TopAbs_FORWARD));
    builder.Add(edge, to.Oriented(TopAbs_REVERSED));
    builder.Degenerated(edge, Standard_True);
    return edge;
  }
  BRepBuilderAPI_MakeEdge made(curve, geometry, from, to);
  if (!made.IsDone())
    throw Error(Fault::stage, "a border curve cannot be laid on the surface (OpenCASCADE error " +
                                  std::to_string(static_cast<int>(made.Error())) + ")");
  return made.Edge();
}

TopoDS_Wire wire_of(const Patch& patch, const Handle(Geom_BSplineSurface) & geometry,
                    const Eigen::Matrix2Xd& loop) {
  const std::vector<Piece> pieces = pieces_of(patch, loop);
  std::vector<TopoDS_Vertex> corners;
  for (const Piece& piece : pieces)
    corners.push_back(
        BRepBuilderAPI_MakeVertex(millimetres(patch.at(piece.uv.col(0)) + patch.surface().origin)));
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (pieces[i].pole) corners[(i + 1) % pieces.size()] = corners[i];
  BRep_Builder builder;
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    builder.Add(wire, edge_of(pieces[i], geometry, corners[i], corners[(i + 1) % pieces.size()]));
  wire.Closed(Standard_True);
  return wire;
}

}  // namespace

void make_face(const Surface& surface, double tolerance, TopoDS_Face& face) {
  const Patch patch(surface);
  const Handle(Geom_BSplineSurface) geometry = geometry_of(patch);
  if (surface.trimming.empty()) {
    BRepBuilderAPI_MakeFace made(geometry, Precision::Confusion());
    if (!made.IsDone()) throw Error(Fault::stage, "OpenCASCADE can make no face of the surface");
    face = made.Face();
  } else {
    BRepBuilderAPI_MakeFace made(
        geometry, wire_of(patch, geometry, clean_loop(patch, surface.trimming.front(), true)),
        Standard_True);
    for (std::size_t i = 1; i < surface.trimming.size(); ++i)
      made.Add(wire_of(patch, geometry, clean_loop(patch, surface.trimming[i], false)));
    if (!made.IsDone()) throw Error(Fault::stage, "OpenCASCADE can make no face of the surface");
    face = made.Face();
  }
  BRepLib::BuildCurves3d(face, kMillimetres * tolerance);
  BRepLib::SameParameter(face, kMillimetres * tolerance);
  if (!BRepCheck_Analyzer(face).IsValid())
    throw Error(Fault::stage, "the trimmed surface is not a valid face")
        .hint("check that no trimming loop crosses itself or another");
}

}  // namespace velum::cad
