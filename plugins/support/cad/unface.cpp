// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "cad/unface.hpp"

#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>

#include "bspline/evaluate.hpp"
#include "cad/face.hpp"
#include "formats/positions.hpp"

namespace velum::cad {
namespace {

using bspline::Patch;
using Places = std::vector<Eigen::Vector2d>;

Handle(Geom_BSplineSurface) geometry_of(const TopoDS_Face& face) {
  const Handle(Geom_BSplineSurface) found =
      Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(face));
  if (found.IsNull())
    throw Error(Fault::input, std::string("the face lies on a ") +
                                  BRep_Tool::Surface(face)->DynamicType()->Name() +
                                  ", expected a B-spline surface");
  const Handle(Geom_BSplineSurface) own = Handle(Geom_BSplineSurface)::DownCast(found->Copy());
  if (own->IsUPeriodic()) own->SetUNotPeriodic();
  if (own->IsVPeriodic()) own->SetVNotPeriodic();
  return own;
}

Eigen::VectorXd vector_of(const TColStd_Array1OfReal& values) {
  Eigen::VectorXd result(values.Length());
  for (int i = 0; i < values.Length(); ++i) result[i] = values.Value(values.Lower() + i);
  return result;
}

Surface surface_of(const Geom_BSplineSurface& geometry) {
  Surface surface;
  surface.degree_u = geometry.UDegree();
  surface.degree_v = geometry.VDegree();
  surface.knots_u = vector_of(geometry.UKnotSequence());
  surface.knots_v = vector_of(geometry.VKnotSequence());
  const int rows = geometry.NbUPoles();
  const int columns = geometry.NbVPoles();
  surface.control.resize(3, Index{rows} * columns);
  if (geometry.IsURational() || geometry.IsVRational())
    surface.weights.resize(surface.control.cols());
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const Index k = Index{i} * columns + j;
      const gp_Pnt p = geometry.Pole(i + 1, j + 1);
      surface.control.col(k) = Eigen::Vector3d(p.X(), p.Y(), p.Z()) / kMillimetres;
      if (surface.weights.size() > 0) surface.weights[k] = geometry.Weight(i + 1, j + 1);
    }
  for (Index a = 0; a < 3; ++a)
    surface.origin[a] = formats::choose_origin(surface.control.row(a).minCoeff(),
                                               surface.control.row(a).maxCoeff());
  surface.control.colwise() -= surface.origin;
  return surface;
}

/// Follows border curves in (u, v) by straight steps.
class LoopReader {
 public:
  LoopReader(const Patch& patch, double tolerance)
      : patch_(patch),
        low_(patch.low()),
        size_(patch.high() - patch.low()),
        tolerance_(tolerance) {}

  [[nodiscard]] Eigen::Matrix2Xd loop(const TopoDS_Wire& wire, const TopoDS_Face& face) {
    places_.clear();
    for (BRepTools_WireExplorer at(wire, face); at.More(); at.Next()) edge(at.Current(), face);
    Eigen::Matrix2Xd result(2, static_cast<Index>(places_.size()));
    for (Index i = 0; i < result.cols(); ++i) result.col(i) = places_[static_cast<std::size_t>(i)];
    return result;
  }

 private:
  /// The edge's places but the last, which the next one begins with.
  void edge(const TopoDS_Edge& edge, const TopoDS_Face& face) {
    double first = 0.0;
    double last = 0.0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (curve.IsNull())
      throw Error(Fault::input, "a border of the face has no curve on its surface");
    const Geom2dAdaptor_Curve part(curve, first, last);
    const int spans = part.NbIntervals(GeomAbs_C3);
    TColStd_Array1OfReal ends(1, spans + 1);
    part.Intervals(ends, GeomAbs_C3);
    const bool reversed = edge.Orientation() == TopAbs_REVERSED;
    for (int i = 1; i <= spans; ++i) {
      const int begin = reversed ? spans + 2 - i : i;
      const int end = reversed ? begin - 1 : begin + 1;
      const double from = ends.Value(begin);
      const double to = ends.Value(end);
      places_.push_back(at(part, from));
      between(part, from, to, places_.back(), at(part, to), 0);
    }
  }

  [[nodiscard]] Eigen::Vector2d at(const Geom2dAdaptor_Curve& curve, double t) const {
    const gp_Pnt2d p = curve.Value(t);
    Eigen::Vector2d uv(p.X(), p.Y());
    // Files keep fifteen digits; more than their rounding is no place of the surface.
    constexpr double kRounding = 1e-6;
    for (Index a = 0; a < 2; ++a) {
      const double share = (uv[a] - low_[a]) / size_[a];
      if (!(share >= -kRounding && share <= 1.0 + kRounding))
        throw Error(Fault::input, "a border leaves the range of its surface")
            .hint("a face across the seam of a closed surface is not read");
      uv[a] = std::clamp(uv[a], low_[a], low_[a] + size_[a]);
    }
    return uv;
  }

  /// Halves the piece until its chord stays on the curve, at its quarters too: an S crosses its
  /// chord in the middle.
  void between(const Geom2dAdaptor_Curve& curve, double from, double to, const Eigen::Vector2d& a,
               const Eigen::Vector2d& b, int level) {
    constexpr int kDeepest = 10;
    if (level == kDeepest) return;
    const double middle = 0.5 * (from + to);
    bool straight = true;
    for (const double share : {0.5, 0.25, 0.75})
      straight = straight && near(at(curve, from + share * (to - from)), a + share * (b - a));
    if (straight) return;
    const Eigen::Vector2d m = at(curve, middle);
    between(curve, from, middle, a, m, level + 1);
    places_.push_back(m);
    between(curve, middle, to, m, b, level + 1);
  }

  [[nodiscard]] bool near(const Eigen::Vector2d& p, const Eigen::Vector2d& q) const {
    return (patch_.at(p) - patch_.at(q)).norm() <= tolerance_;
  }

  const Patch& patch_;
  Eigen::Vector2d low_;
  Eigen::Vector2d size_;
  double tolerance_;
  Places places_;
};

/// Is the loop the border of the surface's whole range?
bool is_whole(const Patch& patch, const Eigen::Matrix2Xd& loop) {
  const Eigen::Vector2d low = patch.low();
  const Eigen::Vector2d size = patch.high() - low;
  double twice = 0.0;
  for (Index i = 0; i < loop.cols(); ++i) {
    const Eigen::Vector2d p = (loop.col(i) - low).cwiseQuotient(size);
    const Eigen::Vector2d q = (loop.col((i + 1) % loop.cols()) - low).cwiseQuotient(size);
    twice += p.x() * q.y() - p.y() * q.x();
  }
  constexpr double kSame = 1e-9;
  return std::abs(std::abs(twice) - 2.0) < kSame;
}

}  // namespace

Surface unface(const TopoDS_Face& oriented, double tolerance) {
  const TopoDS_Face face = TopoDS::Face(oriented.Oriented(TopAbs_FORWARD));
  Surface surface = surface_of(*geometry_of(face));
  const Patch patch(surface);
  LoopReader reader(patch, tolerance);
  const TopoDS_Wire outer = BRepTools::OuterWire(face);
  std::vector<Eigen::Matrix2Xd> loops;
  if (!outer.IsNull()) loops.push_back(reader.loop(outer, face));
  for (TopExp_Explorer at(face, TopAbs_WIRE); at.More(); at.Next())
    if (!at.Current().IsSame(outer)) loops.push_back(reader.loop(TopoDS::Wire(at.Current()), face));
  for (const Eigen::Matrix2Xd& loop : loops)
    if (loop.cols() < 3)
      throw Error(Fault::input, "a border of the face has fewer than three points");
  if (loops.size() == 1 && is_whole(patch, loops.front())) loops.clear();
  surface.trimming = std::move(loops);
  return surface;
}

}  // namespace velum::cad
