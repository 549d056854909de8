// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>
#include <velum/cloud.hpp>
#include <velum/context.hpp>

namespace velum::sails {

/// A cluster seen as an upright sheet: its best plane, and in the plane `height` along what is up
/// and `width` across.
struct Sheet {
  Index points = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< relative to the cloud's origin [m]
  double lean = 0.0;       ///< of the plane from the vertical [rad]: 0 a wall, π/2 a floor
  double height = 0.0;     ///< [m]
  double width = 0.0;      ///< widest of the bands across [m]
  double area = 0.0;       ///< within the outline, in the plane [m²]
  double bend = 0.0;       ///< root mean square distance from the plane [m]
  double roughness = 0.0;  ///< the same from the cubic that fits best [m]
  double top = 1.0;        ///< mean width of the upper quarter / width

  [[nodiscard]] double aspect() const { return width > 0.0 ? height / width : 0.0; }
};

/// The figures of the points `members`; `up` has unit length. Fewer than 20 points, or points on a
/// line, leave all but `points` and `centre` at zero.
Sheet measure(const Cloud& cloud, const std::vector<std::int32_t>& members,
              const Eigen::Vector3d& up, Context& context);

/// What is asked of a sail. Shares are of its width.
struct Demands {
  double min_area = 0.0;           ///< [m²]
  std::optional<double> max_area;  ///< [m²]
  double min_aspect = 1.0;         ///< height / width
  double max_aspect = 7.0;
  double min_bend = 0.012;
  double max_bend = 0.25;
  double smoothness = 0.03;  ///< greatest roughness / width
  double max_lean = 0.9;     ///< [rad]
  double max_top = 0.8;
  std::optional<Eigen::Vector3d> near;  ///< relative to the cloud's origin [m]
  double within = 0.0;                  ///< greatest distance of the centre from there [m]
};

/// How well a sheet meets the demands: 1 all of them with room to spare, under 0.5 not.
struct Verdict {
  double score = 0.0;
  std::string reason;  ///< for or against, in words
  [[nodiscard]] bool sail() const { return score >= 0.5; }
};

Verdict judge(const Sheet& sheet, const Demands& demands);

}  // namespace velum::sails
