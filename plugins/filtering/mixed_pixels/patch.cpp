// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "patch.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace velum::mixed {
namespace {

// Limits below were found on simulated scans of both of the project's scenes.
// Neighbours of a point through which planes are laid.
constexpr std::size_t kLaid = 14;
// Deviations within which a neighbour is on a plane.
constexpr double kOnPlane = 3.0;
// Root mean square residual of a plane's members, in deviations; they were cut off at kOnPlane, so
// that it is a little under 1 for a true plane.
constexpr double kResidual = 0.9;
// Something is behind when one neighbour, or three, are so many deviations farther away.
constexpr double kBehindOne = 4.0;
constexpr double kBehindThree = 2.5;
// Tangents of angles of incidence. A plane met at more than 86 degrees is no surface that a range
// could come from. The ramp that the shares of a spot make between two surfaces is at least three
// spots deep over one spot, 70 degrees; what gets less evidence must be met less steeply.
constexpr double kSteepest = 14.0;
constexpr double kGentle = 2.0;
constexpr double kSteepStrip = 2.5;
constexpr double kGentleStrip = 1.2;
// Share of a quarter's neighbours that are on its plane.
constexpr double kFull = 0.85;

}  // namespace

double Sheet::behind(const Seen& seen) const {
  const double inverse = at + slope.dot(seen.across);
  // The ray to the neighbour does not meet a plane that has turned past it.
  return inverse > 1e-9 ? 1.0 / seen.inverse - 1.0 / inverse : -1e9;
}

Patch::Patch(double range, double noise, double width)
    : range_(range), noise_(noise), width_(width) {}

void Patch::add(const Seen& seen) {
  const double turn = std::atan2(seen.across.y(), seen.across.x()) / (2.0 * std::numbers::pi);
  const auto octant = static_cast<std::size_t>((turn + 1.0) * kOctants) % kOctants;
  around_.push_back(seen);
  octant_.push_back(octant);
  ++totals_[octant];
}

bool Patch::something_behind() const {
  int some = 0;
  for (const Seen& seen : around_) {
    const double behind = 1.0 / seen.inverse - range_;
    if (behind > kBehindOne * noise_) return true;
    if (behind > kBehindThree * noise_) ++some;
  }
  return some >= 3;
}

// Lays planes through the point and pairs of others until one passes the test.
template <class Test>
bool Patch::any_plane(const std::vector<Seen>& of, double steepest, const Test& test) const {
  const std::size_t stride = std::max<std::size_t>(1, of.size() / kLaid);
  for (std::size_t j = stride; j < of.size(); j += stride)
    for (std::size_t i = 0; i < j; i += stride) {
      const std::optional<Sheet> sheet = through(of[i], of[j]);
      if (sheet && sheet->tangent() <= steepest && test(*sheet)) return true;
    }
  return false;
}

bool Patch::on_surface() const {
  return any_plane(around_, kSteepest,
                   [&](const Sheet& sheet) { return carried_by_quarter(sheet); });
}

bool Patch::beside_surface() const {
  std::vector<Seen> sure;
  for (const Seen& seen : around_)
    if (seen.sure) sure.push_back(seen);
  return any_plane(sure, kGentle, [&](const Sheet& sheet) {
    return predicted(sheet, sure, {2.0, 0.5, 8});
  });
}

bool Patch::on_strip() const {
  return any_plane(around_, kSteepStrip, [&](const Sheet& sheet) {
    const int least = sheet.tangent() > kGentleStrip ? 15 : 12;
    return wide(sheet) && predicted(sheet, around_, {2.0, 0.5, least});
  });
}

std::optional<Sheet> Patch::through(const Seen& a, const Seen& b) const {
  const double area = a.across.x() * b.across.y() - a.across.y() * b.across.x();
  // Neighbours on one line with the point fix no plane.
  if (std::abs(area) <= 0.3 * a.across.norm() * b.across.norm()) return std::nullopt;
  Sheet sheet;
  sheet.at = 1.0 / range_;
  const double rise_a = a.inverse - sheet.at;
  const double rise_b = b.inverse - sheet.at;
  sheet.slope << (rise_a * b.across.y() - rise_b * a.across.y()) / area,
      (rise_b * a.across.x() - rise_a * b.across.x()) / area;
  return sheet;
}

bool Patch::on(const Sheet& sheet, const Seen& seen) const {
  return std::abs(sheet.behind(seen)) <= kOnPlane * noise_;
}

bool Patch::carried_by_quarter(const Sheet& sheet) const {
  constexpr Trust kTrust{3.0, 2.0, 4};
  std::array<int, kOctants> members{};
  for (std::size_t k = 0; k < around_.size(); ++k)
    if (on(sheet, around_[k])) ++members[octant_[k]];
  for (std::size_t first = 0; first < kOctants; ++first) {
    const std::size_t second = (first + 1) % kOctants;
    const int count = members[first] + members[second];
    if (count < kTrust.least || members[first] == 0 || members[second] == 0 ||
        count < kFull * (totals_[first] + totals_[second]))
      continue;
    std::vector<Seen> quarter;
    for (std::size_t k = 0; k < around_.size(); ++k)
      if (octant_[k] == first || octant_[k] == second) quarter.push_back(around_[k]);
    if (predicted(sheet, quarter, kTrust)) return true;
  }
  return false;
}

bool Patch::wide(const Sheet& sheet) const {
  constexpr std::size_t kWays = 8;
  static const auto kDirections = [] {
    std::array<Eigen::Vector2d, kWays> made;
    for (std::size_t way = 0; way < kWays; ++way) {
      const double angle = std::numbers::pi * static_cast<double>(way) / kWays;
      made[way] << std::cos(angle), std::sin(angle);
    }
    return made;
  }();
  std::array<double, kWays> low{};
  std::array<double, kWays> high{};
  for (const Seen& seen : around_) {
    if (!on(sheet, seen)) continue;
    for (std::size_t way = 0; way < kWays; ++way) {
      const double along = seen.across.dot(kDirections[way]);
      low[way] = std::min(low[way], along);
      high[way] = std::max(high[way], along);
    }
  }
  for (std::size_t way = 0; way < kWays; ++way)
    if (high[way] - low[way] < width_) return false;
  return true;
}

// Fits a plane to those of `by` that are on the sheet, the point itself left out. The plane must
// fit them to within their noise: a ramp made of mixed pixels does not.
bool Patch::predicted(const Sheet& sheet, const std::vector<Seen>& by, const Trust& trust) const {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  int count = 0;
  for (const Seen& seen : by) {
    if (!on(sheet, seen)) continue;
    ++count;
    const Eigen::Vector3d row(1.0, seen.across.x(), seen.across.y());
    normal += row * row.transpose();
    right += seen.inverse * row;
  }
  if (count < trust.least) return false;
  const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
  const Eigen::Vector3d fit = solver.solve(right);
  const double leverage = solver.solve(Eigen::Vector3d::UnitX())[0];
  if (!(leverage <= trust.leverage)) return false;

  const Sheet best{fit[0], fit.tail<2>()};
  double squares = 0.0;
  for (const Seen& seen : by)
    if (on(sheet, seen)) squares += best.behind(seen) * best.behind(seen);
  // Mean and one deviation of a chi-squared sum.
  const double freedoms = std::max(count - 3, 1);
  const double scale = kResidual * noise_;
  if (squares > scale * scale * (freedoms + std::sqrt(2.0 * freedoms))) return false;
  const double off = std::abs(best.behind({Eigen::Vector2d::Zero(), 1.0 / range_, false}));
  return off <= trust.deviations * noise_ * std::sqrt(1.0 + leverage);
}

}  // namespace velum::mixed
