// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "sail/section.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "sail/penalised.hpp"

namespace velum::sail {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr Index kSpans = 10;
constexpr Index kFewest = 30;          // points of a section
constexpr double kIndependent = 60.0;  // points that err independently, at most

// Luff and leech at one height.
struct Ends {
  Vector3d luff;
  Vector3d leech;
};

// Below clew or tack the sail ends at its foot.
std::optional<Ends> ends_at(const Border& border, double z) {
  auto luff = border.luff.at_height(z);
  auto leech = border.leech.at_height(z);
  if (!luff) luff = z > border.head().z() ? border.top.at_height(z) : border.foot.at_height(z);
  if (!leech)
    leech = z > border.peak().z() ? border.top.at_height(z) : border.foot.reversed().at_height(z);
  if (!luff || !leech) return std::nullopt;
  return Ends{*luff, *leech};
}

// Luff and leech over a range of heights, from a table.
class EndTable {
 public:
  EndTable(const Border& border, double low, double high) : low_(low), step_((high - low) / kRows) {
    for (int i = 0; i <= kRows; ++i) rows_.push_back(ends_at(border, low + i * step_));
  }
  [[nodiscard]] std::optional<Ends> at(double z) const {
    const double place = (z - low_) / step_;
    if (!(place >= 0.0 && place <= kRows)) return std::nullopt;  // no number where low is high
    const auto i = static_cast<std::size_t>(std::min(place, kRows - 1.0));
    if (!rows_[i] || !rows_[i + 1]) return std::nullopt;
    const double s = place - static_cast<double>(i);
    return Ends{(1.0 - s) * rows_[i]->luff + s * rows_[i + 1]->luff,
                (1.0 - s) * rows_[i]->leech + s * rows_[i + 1]->leech};
  }

 private:
  static constexpr int kRows = 64;
  double low_;
  double step_;
  std::vector<std::optional<Ends>> rows_;
};

// A vertex in its section: share of the chord, offset over chord, height off the section over band.
struct Place {
  double t;
  double y;
  double rise;
};

std::vector<Place> places(const Sheet& sheet, const EndTable& table, double z, double low,
                          double high) {
  std::vector<Place> all;
  const double reach = std::max(z - low, high - z);
  for (Index i = 0; i < sheet.points.cols(); ++i) {
    const Vector3d p = sheet.points.col(i);
    if (p.z() < low || p.z() > high) continue;
    const auto ends = table.at(p.z());
    if (!ends) continue;
    const Vector2d chord = (ends->leech - ends->luff).head<2>();
    const Vector2d offset = (p - ends->luff).head<2>();
    const double square = chord.squaredNorm();
    if (!(square > 0.0)) continue;
    const double t = chord.dot(offset) / square;
    if (t < -0.02 || t > 1.02) continue;
    const double y = (chord.x() * offset.y() - chord.y() * offset.x()) / square;
    all.push_back({t, y, (p.z() - z) / reach});
  }
  return all;
}

// Coefficients of the section itself: those of the zeroth power of the rise.
VectorXd profile(const std::vector<Place>& all) {
  const auto n = static_cast<Index>(all.size());
  const Index powers = n >= 150 ? 3 : n >= 60 ? 2 : 1;
  const Index columns = kSpans + 3;
  MatrixXd design(n, powers * columns);
  VectorXd offsets(n);
  for (Index i = 0; i < n; ++i) {
    const Place& place = all[static_cast<std::size_t>(i)];
    const Eigen::RowVectorXd row = basis(std::clamp(place.t, 0.0, 1.0), kSpans);
    double power = 1.0;
    for (Index k = 0; k < powers; ++k) {
      design.row(i).segment(k * columns, columns) = power * row;
      power *= place.rise;
    }
    offsets[i] = place.y;
  }
  MatrixXd penalty = MatrixXd::Zero(powers * columns, powers * columns);
  const MatrixXd block = difference_penalty(columns, 3);
  for (Index k = 0; k < powers; ++k)
    penalty.block(k * columns, k * columns, columns, columns) = block;
  return fit_penalised(design, offsets, VectorXd::Ones(n), penalty, kIndependent)
      .coefficients.col(0)
      .head(columns);
}

// Slope at x = 0 of the parabola through 0 that fits `depth` best over [0, length].
template <class Depth>
double slope_at_end(const Depth& depth, double length) {
  constexpr int kSteps = 20;
  MatrixXd design(kSteps, 2);
  VectorXd values(kSteps);
  for (int i = 0; i < kSteps; ++i) {
    const double x = length * (i + 1) / kSteps;
    design.row(i) << x, x * x;
    values[i] = depth(x);
  }
  return VectorXd(design.colPivHouseholderQr().solve(values))[0];
}

}  // namespace

RawSection fit_section(const Sheet& sheet, const Border& border, double z, double band,
                       double tangent) {
  const auto ends = ends_at(border, z);
  if (!ends)
    throw Error(Fault::stage, "the border is not cut twice by the plane of a section")
        .hint("choose heights between 0 and 1");
  // A band that reaches across the clew would mix sections that end at the leech with some that end
  // at the foot.
  double low = z - band;
  double high = z + band;
  const double clew = border.clew().z();
  (z >= clew ? low : high) = z >= clew ? std::max(low, clew) : std::min(high, clew);
  const std::vector<Place> all = places(sheet, EndTable(border, low, high), z, low, high);
  if (static_cast<Index>(all.size()) < kFewest)
    throw Error(Fault::stage, "a section has " + std::to_string(all.size()) +
                                  " points about it, at least 30 are needed")
        .hint("use a finer scan, or a wider 'band'");
  const VectorXd coefficients = profile(all);
  const auto offset = [&](double t) -> double { return basis(t, kSpans) * coefficients; };

  // In units of the line from luff to leech; the section's own ends are those of the fitted curve.
  const double start = offset(0.0);
  const double rise = offset(1.0) - start;
  const double stretch = std::hypot(1.0, rise);
  const auto depth = [&](double t) { return (offset(t) - start - rise * t) / stretch; };
  constexpr int kSteps = 1000;
  double deepest = 0.0;
  double at = 0.5;
  for (int i = 1; i < kSteps; ++i) {
    const double d = depth(static_cast<double>(i) / kSteps);
    if (std::abs(d) <= std::abs(deepest)) continue;
    deepest = d;
    at = static_cast<double>(i) / kSteps;
  }

  const Vector2d line = (ends->leech - ends->luff).head<2>();
  RawSection section;
  section.values.z = z;
  section.values.chord = line.norm() * stretch;
  section.values.camber = std::abs(deepest) / stretch;
  // The foot on the chord of the point at `at`.
  section.values.draft = (at + rise * (offset(at) - start)) / (stretch * stretch);
  section.values.angle = std::atan2(line.y(), line.x()) + std::atan(rise);
  const double sign = deepest < 0.0 ? -1.0 : 1.0;
  section.values.entry =
      std::atan(sign * slope_at_end([&](double x) { return depth(x); }, tangent) / stretch);
  section.values.exit =
      std::atan(sign * slope_at_end([&](double x) { return depth(1.0 - x); }, tangent) / stretch);
  section.bulge = sign * section.values.camber;
  return section;
}

}  // namespace velum::sail
