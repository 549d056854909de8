// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>

#include "sail/border.hpp"
#include "sail/lattice.hpp"

namespace velum::sail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::uint64_t key(const Cell& cell) {
  return (static_cast<std::uint64_t>(cell.sensor) << 56U) ^
         (static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell.line) & 0xfffffffU) << 28U) ^
         (static_cast<std::uint32_t>(cell.beam) & 0xfffffffU);
}

// Vertices of the border and those that share an edge with one of them.
std::set<std::int32_t> near_border(const Sheet& sheet) {
  std::vector<bool> on(static_cast<std::size_t>(sheet.points.cols()), false);
  for (const std::int32_t v : sheet.loop) on[static_cast<std::size_t>(v)] = true;
  std::set<std::int32_t> near(sheet.loop.begin(), sheet.loop.end());
  const auto triangles = sheet.mesh.triangles();
  for (Index i = 0; i < triangles.cols(); ++i)
    for (int k = 0; k < 3; ++k)
      if (on[static_cast<std::size_t>(triangles(k, i))])
        for (int l = 0; l < 3; ++l) near.insert(triangles(l, i));
  return near;
}

Vector3d normal_at(const Sheet& sheet, std::int32_t vertex, std::vector<Neighbour>& around) {
  const Cloud& cloud = sheet.mesh.vertices();
  cloud.neighbours().nearest(cloud.positions().col(vertex), 24, around);
  Vector3d mean = Vector3d::Zero();
  for (const Neighbour& one : around) mean += sheet.points.col(one.index);
  mean /= static_cast<double>(around.size());
  Matrix3d spread = Matrix3d::Zero();
  for (const Neighbour& one : around) {
    const Vector3d d = sheet.points.col(one.index) - mean;
    spread += d * d.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Matrix3d> eigen;
  eigen.computeDirect(spread);
  return eigen.eigenvectors().col(0);
}

}  // namespace

bool is_scan(const Cloud& cloud) {
  const auto whole = [&](const char* name) {
    return cloud.has(name) && cloud.column(name).scalar() == Scalar::i32 &&
           cloud.column(name).width() == 1;
  };
  return !cloud.sensors().empty() && whole(column::kBeam) && whole(column::kLine);
}

bool is_scan(const Mesh& mesh) {
  return is_scan(mesh.vertices());
}

Lattice::Lattice(const Cloud& cloud)
    : beam_(cloud.column(column::kBeam).vector<std::int32_t>()),
      line_(cloud.column(column::kLine).vector<std::int32_t>()) {
  for (Index i = 0; i < cloud.size(); ++i) {
    sensor_.push_back(cloud.sensor_of(i).value_or(0));
    by_cell_.emplace(key(cell(static_cast<std::int32_t>(i))), static_cast<std::int32_t>(i));
  }
}

std::int32_t Lattice::find(const Cell& cell, bool lines, int steps) const {
  const Cell other{cell.sensor, cell.line + (lines ? steps : 0), cell.beam + (lines ? 0 : steps)};
  const auto found = by_cell_.find(key(other));
  return found == by_cell_.end() ? -1 : found->second;
}

bool Lattice::ends_at(const Cell& cell, bool lines, int sign) const {
  for (int k = 1; k <= 3; ++k)
    if (find(cell, lines, sign * k) >= 0) return false;
  return true;
}

Lattice::Inner Lattice::inner(const Cell& cell, bool lines, int sign, int reach) const {
  int steps = 1;
  while (steps < reach && find(cell, lines, -sign * steps) < 0) ++steps;
  return {find(cell, lines, -sign * steps), steps};
}

std::optional<Vector3d> half_step_on(const Vector3d& eye, const Vector3d& p, const Vector3d& inner,
                                     int steps, const Vector3d& normal) {
  const Vector3d ray = (p - eye).normalized();
  const Vector3d step = (ray - (inner - eye).normalized()) / steps;
  const Vector3d beyond = (ray + 0.5 * step).normalized();
  const double facing = beyond.dot(normal);
  if (std::abs(facing) < 0.1) return std::nullopt;
  const Vector3d at = eye + beyond * ((p - eye).dot(normal) / facing);
  const double far = (p - inner).norm() / steps;
  if ((at - p).norm() > 2.0 * far) return std::nullopt;
  return at;
}

double place_on(const Outline& outline, const Vector3d& p) {
  Index nearest = 0;
  (outline.points.colwise() - p).colwise().squaredNorm().minCoeff(&nearest);
  const Index n = outline.points.cols();
  const Vector3d before = outline.points.col((nearest + n - 1) % n);
  const Vector3d after = outline.points.col((nearest + 1) % n);
  const double along = (p - outline.points.col(nearest)).dot((after - before).normalized());
  const double arc = outline.arc[nearest] + along;
  return arc < 0.0 ? arc + outline.length : arc;
}

EdgePoints edge_of_scan(const Sheet& sheet, const Outline& outline) {
  const Cloud& cloud = sheet.mesh.vertices();
  const Lattice lattice(cloud);
  std::vector<Vector3d> eyes;
  for (std::size_t i = 0; i < cloud.sensors().size(); ++i)
    eyes.emplace_back(sheet.frame.axes * cloud.sensor_position(i).cast<double>());
  std::vector<Vector3d> made;
  std::vector<Vector3d> moves;
  std::vector<Neighbour> around;
  for (const std::int32_t vertex : near_border(sheet)) {
    const Cell cell = lattice.cell(vertex);
    if (cell.sensor >= eyes.size()) continue;
    const Vector3d p = sheet.points.col(vertex);
    std::optional<Vector3d> normal;
    for (const bool lines : {false, true})
      for (const int sign : {-1, 1}) {
        const Lattice::Inner inside = lattice.inner(cell, lines, sign, 3);
        const std::int32_t inner = inside.vertex;
        const int steps = inside.steps;
        if (inner < 0 || !lattice.ends_at(cell, lines, sign)) continue;
        if (!normal) normal = normal_at(sheet, vertex, around);
        const auto at = half_step_on(eyes[cell.sensor], p, sheet.points.col(inner), steps, *normal);
        if (!at) continue;
        made.push_back(*at);
        moves.push_back(*at - p);
      }
  }
  const auto n = static_cast<Index>(made.size());
  EdgePoints edge{Eigen::Matrix3Xd(3, n), Eigen::VectorXd(n), Eigen::VectorXd::Ones(n),
                  Eigen::Matrix3Xd(3, n), 0.0};
  if (n == 0) return edge;
  std::vector<double> lengths;
  for (Index i = 0; i < n; ++i) {
    edge.points.col(i) = made[static_cast<std::size_t>(i)];
    edge.moves.col(i) = moves[static_cast<std::size_t>(i)];
    edge.arc[i] = place_on(outline, edge.points.col(i));
    lengths.push_back(edge.moves.col(i).norm());
  }
  const auto middle = lengths.begin() + n / 2;
  std::nth_element(lengths.begin(), middle, lengths.end());
  edge.step = 2.0 * *middle;
  return edge;
}

}  // namespace velum::sail
