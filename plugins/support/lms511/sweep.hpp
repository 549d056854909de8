// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lms511/lines.hpp"
#include "lms511/tilt.hpp"
#include "velum/cloud.hpp"
#include "velum/context.hpp"

namespace velum::lms511 {

/// How the scanner is mounted on what turns it.
enum class Mounting : std::uint8_t {
  plate,      ///< tilts about its x axis, which lies across the view (thesis 2.3)
  turntable,  ///< turns about its 90-degree direction, which stands upright
};

/// Which of a beam's echoes become points.
enum class Echoes : std::uint8_t { all, first, last };

/// What a calibration finds out about a scanner and its mounting.
struct Calibration {
  /// Where the scanner's origin stands when the tilt is 0, seen from the axis [m].
  Eigen::Vector3d lever = Eigen::Vector3d::Zero();
  /// Small turns of the scanner about x, y and z of the plate, in that order [rad].
  Eigen::Vector3d misalignment = Eigen::Vector3d::Zero();
  /// Added to the start time of a line: where in the revolution the device takes it [s].
  double time_offset = 0.0;
};

struct SweepSettings {
  TiltSettings tilt;
  Mounting mounting = Mounting::plate;
  Calibration calibration;
  Echoes echoes = Echoes::all;
  std::string name = "lms511";  ///< of the sensor
  double range_min = 0.0;       ///< nearer returns are left out [m]
  double range_max = 100.0;     ///< farther ones too [m]
};

struct SweepCounts {
  std::uint64_t untilted = 0;  ///< returns at times whose tilt is not known
  std::uint64_t out_of_range = 0;
  double span = 0.0;  ///< from the first line to the last [s]
  /// From the trigger to the first line [s]; 0 without one.
  double skew = 0.0;
};

/// The turn of the plate by `tilt` [rad].
[[nodiscard]] Eigen::Matrix3d axis_turn(Mounting mounting, double tilt);
/// The turn of small angles about x, then y, then z.
[[nodiscard]] Eigen::Matrix3d misalignment_turn(const Eigen::Vector3d& angles);

/// Maps the plane of the beams to the cloud's frame at a tilt: y = axis turn * (misalignment * p +
/// lever).
class Mount {
 public:
  Mount(Mounting mounting, const Calibration& calibration);
  /// The point at `range` [m] along the beam at `angle`, with the plate at `tilt`.
  [[nodiscard]] Eigen::Vector3d point(double range, double angle, double tilt) const {
    const Eigen::Vector3d p =
        right_ * (range * std::cos(angle)) + ahead_ * (range * std::sin(angle)) + lever_;
    return turned(p, tilt);
  }
  /// The scanner in the cloud's frame: turned as at tilt 0 (x right, y ahead, z up), standing where
  /// its origin is at `tilt`.
  [[nodiscard]] Pose sensor(double tilt) const;

 private:
  [[nodiscard]] Eigen::Vector3d turned(const Eigen::Vector3d& p, double tilt) const {
    const double c = std::cos(tilt);
    const double s = std::sin(tilt);
    if (mounting_ == Mounting::plate) return {p.x(), c * p.y() - s * p.z(), s * p.y() + c * p.z()};
    return {c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()};
  }
  Mounting mounting_;
  Eigen::Vector3d right_;
  Eigen::Vector3d ahead_;
  Eigen::Vector3d lever_;
};

/// The time of the beam at `angle` [rad], seconds after the start time of its line: the mirror
/// turns evenly, and the start time is that of the beam at -5 degrees.
[[nodiscard]] double beam_delay(double angle, double frequency);

/// Turns lines into points. Columns: beam, line, tilt, time [s] since the sweep's begin, range [m],
/// sensor; intensity when the device sent remission; echo when it sent more than one. The sweep
/// begins at the trigger, or with the first line. `counts` says what was left out.
[[nodiscard]] Cloud make_sweep(const LineGatherer& lines, const SweepSettings& settings,
                               SweepCounts& counts, Context& context);

}  // namespace velum::lms511
