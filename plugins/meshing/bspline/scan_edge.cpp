// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scan_edge.hpp"

#include <Eigen/LU>

#include "sail/lattice.hpp"

namespace velum::meshing {
namespace {

using Eigen::Matrix2Xd;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kReach = 6;  // cells inward to the next return

class ScanEdge {
 public:
  ScanEdge(const Cloud& cloud, const FittedSheet& sheet)
      : lattice_(cloud), patch_(sheet.surface), sheet_(sheet) {
    for (std::size_t i = 0; i < cloud.sensors().size(); ++i)
      eyes_.emplace_back(cloud.sensor_position(i).cast<double>());
  }

  sail::EdgePoints find(const PointOutline& outline, const Matrix2Xd& plane) {
    for (const std::int32_t vertex : outline.near) {
      const sail::Cell cell = lattice_.cell(vertex);
      if (cell.sensor >= eyes_.size()) continue;
      for (const bool lines : {false, true})
        for (const int sign : {-1, 1}) add(vertex, cell, lines, sign, plane);
    }
    sail::EdgePoints edge;
    const auto n = static_cast<Index>(places_.size());
    edge.points = Matrix3Xd::Zero(3, n);
    edge.moves = Matrix3Xd::Zero(3, n);
    edge.weights = VectorXd::Ones(n);
    edge.arc.resize(n);
    for (Index i = 0; i < n; ++i) {
      const Vector2d place = places_[static_cast<std::size_t>(i)];
      const Vector2d move = moves_[static_cast<std::size_t>(i)];
      edge.points.col(i) << place.x(), 0.0, place.y();
      edge.moves.col(i) << move.x(), 0.0, move.y();
    }
    return edge;
  }

 private:
  void add(std::int32_t vertex, const sail::Cell& cell, bool lines, int sign,
           const Matrix2Xd& plane) {
    if (!lattice_.ends_at(cell, lines, sign)) return;
    const sail::Lattice::Inner inner = lattice_.inner(cell, lines, sign, kReach);
    if (inner.vertex < 0) return;
    const Vector2d uv = sheet_.uv.col(vertex);
    const bspline::Derivatives d = patch_.derivatives(uv);
    const auto at =
        sail::half_step_on(eyes_[cell.sensor], d.point, patch_.at(sheet_.uv.col(inner.vertex)),
                           inner.steps, d.normal());
    if (!at) return;
    Eigen::Matrix<double, 3, 2> slopes;
    slopes << d.du, d.dv;
    const Vector2d step =
        (slopes.transpose() * slopes).ldlt().solve(slopes.transpose() * (*at - d.point));
    const Vector2d place = sheet_.frame.to_plane(uv + step);
    if (!place.allFinite()) return;
    places_.push_back(place);
    moves_.emplace_back(place - plane.col(vertex));
  }

  sail::Lattice lattice_;
  bspline::Patch patch_;
  const FittedSheet& sheet_;
  std::vector<Vector3d> eyes_;
  std::vector<Vector2d> places_;
  std::vector<Vector2d> moves_;
};

}  // namespace

sail::EdgePoints scan_edge(const Cloud& cloud, const FittedSheet& sheet,
                           const PointOutline& outline, const Matrix2Xd& plane) {
  return ScanEdge(cloud, sheet).find(outline, plane);
}

}  // namespace velum::meshing
