// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "sail/corners.hpp"
#include "sail/curve.hpp"
#include "sail/sheet.hpp"

namespace velum::sail {

/// Points of which the sail's edge is the mean, each with the place on the outline that it belongs
/// to.
struct EdgePoints {
  Eigen::Matrix3Xd points;  ///< in sail axes
  Eigen::VectorXd arc;      ///< along the outline [m]
  Eigen::VectorXd weights;
  Eigen::Matrix3Xd moves;  ///< how far each was moved outward [m]
  /// Usual step between returns where points were moved [m]; 0: they are the outline's own.
  double step = 0.0;
};

/// The outline's own vertices.
[[nodiscard]] EdgePoints edge_as_is(const Outline& outline);

/// Can edge_of_scan be asked? It needs the columns beam and line, and sensors.
[[nodiscard]] bool is_scan(const Mesh& mesh);

/// Place along the outline of the vertex nearest to p, moved by the offset along the outline there.
[[nodiscard]] double place_on(const Outline& outline, const Eigen::Vector3d& p);

/// The edge that a scan missed. On average the last return of a scan line lies half a beam step
/// inside the cloth's edge, and the last line half a tilt step: each last return next to the
/// outline, along its line or across lines, is moved outward on the local tangent plane by half the
/// angle to its inner neighbour. Every point so made is right on average, whatever the edge's
/// direction, where both kinds of neighbour are missing as where one is.
[[nodiscard]] EdgePoints edge_of_scan(const Sheet& sheet, const Outline& outline);

/// The sail's edge as smooth curves between corners, in sail axes.
struct Border {
  Curve luff;   ///< tack to head
  Curve leech;  ///< clew to peak
  Curve foot;   ///< tack to clew
  Curve top;    ///< head to peak
  [[nodiscard]] Eigen::Vector3d tack() const { return luff.front(); }
  [[nodiscard]] Eigen::Vector3d head() const { return luff.back(); }
  [[nodiscard]] Eigen::Vector3d clew() const { return leech.front(); }
  [[nodiscard]] Eigen::Vector3d peak() const { return leech.back(); }
};

/// Smooth curves through the edge's points between the outline's corners. Where the edge lies
/// beyond the outline, neighbouring curves are cut or lengthened to where they come nearest to each
/// other; else they meet half-way between their ends. The top of a sail that is too narrow to have
/// a direction is level. Throws Error (Fault::stage) when a side has too few points.
[[nodiscard]] Border make_border(const Outline& outline, const EdgePoints& edge);

/// Area between the outline and the border's curves, positive where they lie outside [m²].
[[nodiscard]] double strip_area(const Sheet& sheet, const Outline& outline, const Border& border);

}  // namespace velum::sail
