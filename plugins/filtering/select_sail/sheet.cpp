// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "sheet.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/plane_fit.hpp"

namespace velum::sails {
namespace {

constexpr Index kLeastPoints = 20;
constexpr std::size_t kBands = 24;
constexpr double kNone = std::numeric_limits<double>::infinity();

// The frame of the sheet: across, up in the plane, and off it.
struct Frame {
  Eigen::Vector3d centre;
  Eigen::Matrix3d axes;
  [[nodiscard]] Eigen::Vector3d local(const Eigen::Vector3d& point) const {
    return axes.transpose() * (point - centre);
  }
};

Frame frame_of(const geometry::PlaneFit& plane, const Eigen::Vector3d& up) {
  Eigen::Vector3d rise = up - up.dot(plane.normal) * plane.normal;
  // Of a level sheet no direction is up; any will do, as it is refused for being level.
  if (rise.norm() < 1e-6) rise = plane.normal.unitOrthogonal();
  rise.normalize();
  Frame frame{plane.centroid, {}};
  frame.axes.col(0) = rise.cross(plane.normal);
  frame.axes.col(1) = rise;
  frame.axes.col(2) = plane.normal;
  return frame;
}

// Root mean square distance off the cubic over the plane. Coordinates are scaled to about 1.
class Cubic {
 public:
  explicit Cubic(double scale) : scale_(scale) {}
  void add(const Eigen::Vector3d& p) {
    const double x = p.x() / scale_;
    const double y = p.y() / scale_;
    Row row;
    row << 1.0, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y;
    normal_.noalias() += row * row.transpose();
    right_ += p.z() * row;
    squares_ += p.z() * p.z();
    ++count_;
  }
  [[nodiscard]] double residual() const {
    const double left = squares_ - right_.dot(normal_.ldlt().solve(right_));
    return std::sqrt(std::max(left, 0.0) / static_cast<double>(count_));
  }

 private:
  using Row = Eigen::Matrix<double, 10, 1>;
  double scale_;
  Eigen::Matrix<double, 10, 10> normal_ = Eigen::Matrix<double, 10, 10>::Zero();
  Row right_ = Row::Zero();
  double squares_ = 0.0;
  Index count_ = 0;
};

// Widths of the sheet in bands of equal height, from the foot up. Bands without points take no
// part: what the scanner missed says nothing of the outline.
struct Outline {
  std::array<double, kBands> low;
  std::array<double, kBands> high;
  Outline() {
    low.fill(kNone);
    high.fill(-kNone);
  }
  [[nodiscard]] double width(std::size_t band) const {
    return std::max(high[band] - low[band], 0.0);
  }
  [[nodiscard]] double mean(std::size_t from, std::size_t to) const {
    double sum = 0.0;
    int count = 0;
    for (std::size_t band = from; band < to; ++band)
      if (high[band] >= low[band]) {
        sum += width(band);
        ++count;
      }
    return count > 0 ? sum / count : 0.0;
  }
  [[nodiscard]] double widest() const {
    double most = 0.0;
    for (std::size_t band = 0; band < kBands; ++band) most = std::max(most, width(band));
    return most;
  }
};

}  // namespace

Sheet measure(const Cloud& cloud, const std::vector<std::int32_t>& members,
              const Eigen::Vector3d& up, Context& context) {
  context.check();
  const ConstPoints positions = cloud.positions();
  Sheet sheet;
  sheet.points = static_cast<Index>(members.size());
  if (members.empty()) return sheet;
  geometry::PointMoments moments(positions.col(members.front()).cast<double>());
  for (const std::int32_t i : members) moments.add(positions.col(i).cast<double>());
  const geometry::PlaneFit plane = moments.plane();
  sheet.centre = plane.centroid;
  // Twenty points, and not all on one line, are the least that a cubic means anything for.
  if (sheet.points < kLeastPoints || !(plane.spread[1] > 1e-9 * plane.spread[2])) return sheet;

  const Frame frame = frame_of(plane, up);
  const double scale = std::sqrt(plane.spread[2]);
  double foot = kNone;
  double head = -kNone;
  Cubic cubic(scale);
  for (const std::int32_t i : members) {
    const Eigen::Vector3d p = frame.local(positions.col(i).cast<double>());
    foot = std::min(foot, p.y());
    head = std::max(head, p.y());
    cubic.add(p);
  }
  sheet.height = head - foot;
  if (!(sheet.height > 0.0)) return sheet;
  context.check();
  Outline outline;
  for (const std::int32_t i : members) {
    const Eigen::Vector3d p = frame.local(positions.col(i).cast<double>());
    const double share = (p.y() - foot) / sheet.height * static_cast<double>(kBands);
    const std::size_t band = std::min(static_cast<std::size_t>(share), kBands - 1);
    outline.low[band] = std::min(outline.low[band], p.x());
    outline.high[band] = std::max(outline.high[band], p.x());
  }
  sheet.width = outline.widest();
  sheet.area = outline.mean(0, kBands) * sheet.height;
  sheet.top = sheet.width > 0.0 ? outline.mean(kBands - kBands / 4, kBands) / sheet.width : 1.0;
  sheet.lean = std::asin(std::min(std::abs(plane.normal.dot(up)), 1.0));
  sheet.bend = plane.rms();
  sheet.roughness = cubic.residual();
  return sheet;
}

}  // namespace velum::sails
