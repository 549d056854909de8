// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/sail.hpp"

#include <algorithm>
#include <cmath>

namespace velum::scene {
namespace {

using Eigen::Vector3d;

Spline spline_of(const std::vector<SailSection>& sections, double SailSection::*member) {
  std::vector<double> x;
  std::vector<double> y;
  for (const SailSection& section : sections) {
    x.push_back(section.height);
    y.push_back(section.*member);
  }
  return {std::move(x), std::move(y)};
}

// The camber line y = t (1 - t) (a + b t) of a unit chord: y'(draft) = 0, y(draft) = camber.
struct Profile {
  double a;
  double b;
  Profile(double camber, double draft) {
    const double ratio = -(1.0 - 2.0 * draft) / (draft * (2.0 - 3.0 * draft));
    a = camber / (draft * (1.0 - draft) * (1.0 + ratio * draft));
    b = ratio * a;
  }
  [[nodiscard]] double operator()(double t) const { return t * (1.0 - t) * (a + b * t); }
};

// Length of curve(0) ... curve(1): chords of 4096 steps, whose error is of the order of 1e-7.
template <class Curve>
double length(const Curve& curve) {
  constexpr int kSteps = 4096;
  double sum = 0.0;
  Vector3d last = curve(0.0);
  for (int i = 1; i <= kSteps; ++i) {
    const Vector3d next = curve(static_cast<double>(i) / kSteps);
    sum += (next - last).norm();
    last = next;
  }
  return sum;
}

}  // namespace

Sail::Sail(SailDesign design)
    : design_(std::move(design)),
      chord_(spline_of(design_.sections, &SailSection::chord)),
      camber_(spline_of(design_.sections, &SailSection::camber)),
      draft_(spline_of(design_.sections, &SailSection::draft)),
      twist_(spline_of(design_.sections, &SailSection::twist)) {}

Vector3d Sail::at(double t, double height) const {
  const SailDesign& d = design_;
  const double angle = d.angle + twist_(height);
  const Vector3d along = std::cos(angle) * d.aft + std::sin(angle) * d.lee;
  const Vector3d out = std::cos(angle) * d.lee - std::sin(angle) * d.aft;
  const Profile profile(camber_(height), draft_(height));
  const Vector3d luff = d.tack + height * (d.head - d.tack) +
                        4.0 * height * (1.0 - height) * (d.sag_aft * d.aft + d.sag_lee * d.lee);
  return luff + chord_(height) * (t * along + profile(t) * out);
}

double Sail::foot(double t) const {
  const double rise = (design_.head - design_.tack).dot(design_.up);
  return design_.clew_height * t - design_.foot_round / rise * 4.0 * t * (1.0 - t);
}

Vector3d Sail::point(double t, double w) const {
  const double low = foot(t);
  return at(t, low + (1.0 - low) * w);
}

SectionValues Sail::section(double height) const {
  SectionValues values;
  values.z = at(0.0, height).dot(design_.up);
  values.chord = chord_(height);
  values.camber = camber_(height);
  values.draft = draft_(height);
  values.angle = design_.angle + twist_(height);
  const Profile profile(values.camber, values.draft);
  values.entry = std::atan(profile.a);
  values.exit = std::atan(profile.a + profile.b);
  return values;
}

double Sail::luff() const {
  return length([&](double s) { return at(0.0, s); });
}
double Sail::leech() const {
  const double low = design_.clew_height;
  return length([&](double s) { return at(1.0, low + (1.0 - low) * s); });
}
double Sail::foot() const {
  return length([&](double s) { return at(s, foot(s)); });
}

double Sail::area() const {
  const Grid fine = grid(400, 400);
  double sum = 0.0;
  for (Index i = 0; i < fine.triangles.cols(); ++i) {
    const Vector3d a = fine.vertices.col(fine.triangles(0, i));
    const Vector3d b = fine.vertices.col(fine.triangles(1, i));
    const Vector3d c = fine.vertices.col(fine.triangles(2, i));
    sum += 0.5 * (b - a).cross(c - a).norm();
  }
  return sum;
}

Sail::Grid Sail::grid(Index across, Index along) const {
  Grid grid;
  grid.vertices.resize(3, (across + 1) * (along + 1));
  for (Index j = 0; j <= along; ++j)
    for (Index i = 0; i <= across; ++i)
      grid.vertices.col(j * (across + 1) + i) =
          point(static_cast<double>(i) / static_cast<double>(across),
                static_cast<double>(j) / static_cast<double>(along));
  // Which way round is counter-clockwise from leeward depends on the side to which the sail leans.
  const bool turned = design_.aft.cross(design_.up).dot(design_.lee) < 0.0;
  grid.triangles.resize(3, 2 * across * along);
  for (Index j = 0; j < along; ++j)
    for (Index i = 0; i < across; ++i) {
      const auto a = static_cast<std::int32_t>(j * (across + 1) + i);
      const auto b = a + 1;
      const auto c = static_cast<std::int32_t>(a + across + 1);
      const auto d = c + 1;
      const Index k = 2 * (j * across + i);
      if (turned) {
        grid.triangles.col(k) << a, d, b;
        grid.triangles.col(k + 1) << a, c, d;
      } else {
        grid.triangles.col(k) << a, b, d;
        grid.triangles.col(k + 1) << a, d, c;
      }
    }
  return grid;
}

double Sail::grid_error(Index across, Index along) const {
  // The farthest that a cell's surface is from the middle of its diagonal and of its sides; every
  // third cell each way is enough for a smooth surface.
  double worst = 0.0;
  for (Index j = 0; j < along; j += 3)
    for (Index i = 0; i < across; i += 3) {
      const auto corner = [&](double di, double dj) {
        return point((static_cast<double>(i) + di) / static_cast<double>(across),
                     (static_cast<double>(j) + dj) / static_cast<double>(along));
      };
      const Vector3d a = corner(0, 0);
      worst = std::max({worst, (corner(0.5, 0.5) - 0.5 * (a + corner(1, 1))).norm(),
                        (corner(0.5, 0.0) - 0.5 * (a + corner(1, 0))).norm(),
                        (corner(0.0, 0.5) - 0.5 * (a + corner(0, 1))).norm()});
    }
  return worst;
}

Sail::Grid Sail::grid_within(double error) const {
  Index across = 40;
  Index along = 60;
  // The error falls with the square of the step; 1000 cells a side bound memory and time.
  for (double worst = grid_error(across, along); worst > error && along < 1000;
       worst = grid_error(across, along)) {
    const double factor = std::clamp(std::sqrt(worst / error), 1.1, 2.0);
    across = static_cast<Index>(std::ceil(static_cast<double>(across) * factor));
    along = static_cast<Index>(std::ceil(static_cast<double>(along) * factor));
  }
  return grid(across, along);
}

}  // namespace velum::scene
