// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/context.hpp>

#include "sail/border.hpp"

namespace velum::sail {

/// A section of the sail by a plane normal to `up`. Angles [rad].
struct Section {
  double height = 0.0;  ///< share of the way from tack to head
  double z = 0.0;       ///< along `up`, true coordinates [m]
  double chord = 0.0;   ///< [m]
  double camber = 0.0;  ///< greatest distance from the chord, in the plane / chord
  double draft = 0.0;   ///< foot of that distance from the luff / chord
  double angle = 0.0;   ///< of the chord to aft, positive to leeward
  double entry = 0.0;   ///< between chord and tangent at the luff
  double exit = 0.0;    ///< between chord and tangent at the leech
};

struct Options {
  std::vector<double> heights{0.25, 0.5, 0.75};
  double band = 0.1;     ///< half width of the band of points that a section is fitted to / height
  double tangent = 0.1;  ///< share of the chord over which a tangent is fitted
  bool compensate = false;  ///< take the edge from edge_of_scan
};

struct Shape {
  std::vector<Section> sections;
  double luff = 0.0;  ///< lengths [m]
  double leech = 0.0;
  double foot = 0.0;
  double top = 0.0;      ///< between head and peak
  double area = 0.0;     ///< [m²]
  double moved = 0.0;    ///< mean outward move of the border [m]
  Eigen::Vector3d tack;  ///< corners in true coordinates [m]
  Eigen::Vector3d clew;
  Eigen::Vector3d head;
  Eigen::Vector3d peak;
};

/// A mesh may be noisy: border and sections are smooth curves fitted to its vertices. Throws Error
/// (Fault::stage) when it is no sail, or a section has too few points.
[[nodiscard]] Shape measure(const Mesh& mesh, const Eigen::Vector3d& up, const Eigen::Vector3d& bow,
                            const Options& options, Context& context);

/// A surface is smooth: measured as it is, with its own derivatives, along its trimming loop.
/// Throws Error (Fault::stage) when it is not sound, or no sail.
[[nodiscard]] Shape measure(const Surface& surface, const Eigen::Vector3d& up,
                            const Eigen::Vector3d& bow, const std::vector<double>& heights,
                            Context& context);

}  // namespace velum::sail
