// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "scene/spline.hpp"
#include "velum/mesh.hpp"

namespace velum::scene {

/// A horizontal section of a sail as its maker gives it.
struct SailSection {
  double height = 0.0;  ///< share of the way from tack to head
  double chord = 0.0;   ///< [m]
  double camber = 0.0;  ///< greatest distance from the chord / chord
  double draft = 0.0;   ///< where that is, from the luff / chord; between 1/3 and 2/3
  double twist = 0.0;   ///< [rad] added to the sail's angle, opening to leeward
};

/// What defines a sail. `up`, `aft` and `lee` are unit vectors at right angles; horizontal means
/// normal to `up`.
struct SailDesign {
  Eigen::Vector3d tack = Eigen::Vector3d::Zero();
  Eigen::Vector3d head = Eigen::Vector3d::UnitZ();  ///< the luff's upper end
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d aft = -Eigen::Vector3d::UnitX();
  Eigen::Vector3d lee = -Eigen::Vector3d::UnitY();
  double sag_aft = 0.0;               ///< [m] of the luff at half height
  double sag_lee = 0.0;               ///< [m] of the luff at half height
  double angle = 0.0;                 ///< [rad] of the chords to `aft`, before twist
  double clew_height = 0.0;           ///< as the heights of the sections
  double foot_round = 0.0;            ///< [m] that the foot hangs below the line from tack to clew
  std::vector<SailSection> sections;  ///< by ascending height
};

/// What a section measures. Angles [rad]; twist is that of the chord to `aft`.
struct SectionValues {
  double z = 0.0;  ///< height along `up` [m]
  double chord = 0.0;
  double camber = 0.0;
  double draft = 0.0;
  double angle = 0.0;
  double entry = 0.0;  ///< between chord and tangent at the luff
  double exit = 0.0;   ///< between chord and tangent at the leech
};

/// A sail as a smooth parametric surface. Every horizontal section is the cubic
/// y = t (1 - t) (a + b t) over its chord, with a and b from camber and draft; chord, camber, draft
/// and twist run through those of the listed sections as natural cubic splines of the height.
class Sail {
 public:
  explicit Sail(SailDesign design);

  [[nodiscard]] const SailDesign& design() const { return design_; }
  /// The point at share `t` of the chord from the luff, on the section at `height`.
  [[nodiscard]] Eigen::Vector3d at(double t, double height) const;
  /// The height of the foot below share `t` of the chord.
  [[nodiscard]] double foot(double t) const;
  /// The same surface over the unit square: w = 0 is the foot, w = 1 the head.
  [[nodiscard]] Eigen::Vector3d point(double t, double w) const;

  [[nodiscard]] SectionValues section(double height) const;
  [[nodiscard]] Eigen::Vector3d clew() const { return at(1.0, design_.clew_height); }
  [[nodiscard]] double luff() const;   ///< length [m]
  [[nodiscard]] double leech() const;  ///< from clew to the leech's upper end [m]
  [[nodiscard]] double foot() const;   ///< from tack to clew [m]
  [[nodiscard]] double area() const;   ///< [m²]

  struct Grid {
    Eigen::Matrix3Xd vertices;  ///< row by row from the foot, each from luff to leech
    Triangles triangles;        ///< counter-clockwise seen from leeward
  };
  [[nodiscard]] Grid grid(Index across, Index along) const;
  /// The coarsest of a series of grids that is nowhere farther than `error` [m] from the surface,
  /// as measured at the middle of its cells.
  [[nodiscard]] Grid grid_within(double error) const;

 private:
  [[nodiscard]] double grid_error(Index across, Index along) const;

  SailDesign design_;
  Spline chord_;
  Spline camber_;
  Spline draft_;
  Spline twist_;
};

}  // namespace velum::scene
