// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "velum/parameter.hpp"

namespace velum::lms511 {

/// Where the tilt of a beam comes from.
enum class TiltSource : std::uint8_t { fixed, constant, trapezoid, encoder, file, feed };

/// How the plate turns, as a user says it.
struct TiltSettings {
  TiltSource source = TiltSource::fixed;
  double start = 0.0;                    ///< [rad]
  std::optional<double> end{};           ///< [rad]
  std::optional<double> speed{};         ///< [rad/s], without sign: the end says which way
  std::optional<double> acceleration{};  ///< [rad/s^2]
  double counts = 0.0;           ///< of the encoder for one turn; negative: counts backwards
  double zero = 0.0;             ///< the encoder's count at tilt 0
  std::filesystem::path file{};  ///< lines of time [s] and angle [deg]

  /// Throws Error (Fault::graph) at the parameter that is missing or makes no sense.
  void check() const;
  /// Seconds that a law takes from start to end; nothing where that is not known beforehand.
  [[nodiscard]] std::optional<double> duration() const;
};

/// The tilt as a function of time.
class TiltCurve {
 public:
  struct Knot {
    double time = 0.0;   ///< [s] since the sweep began
    double angle = 0.0;  ///< [rad]
  };

  /// A law (fixed, constant, trapezoid); `span` [s] is how long the sweep took, which gives the
  /// speed where only start and end are known.
  TiltCurve(const TiltSettings& settings, double span);
  /// Straight between measured knots, and on for `beyond` [s] before the first and after the last.
  /// The knots are put in the order of their times.
  TiltCurve(std::vector<Knot> knots, double beyond);

  /// Nothing where the tilt is not known.
  [[nodiscard]] std::optional<double> at(double time) const;
  /// A tilt in the middle of what is known.
  [[nodiscard]] double middle() const;

 private:
  [[nodiscard]] double trapezoid(double time) const;

  TiltSource source_ = TiltSource::fixed;
  double start_ = 0.0;
  double end_ = 0.0;
  bool ends_ = false;
  double speed_ = 0.0;
  double acceleration_ = 0.0;
  std::vector<Knot> knots_;
  double beyond_ = 0.0;
};

/// Reads lines of time [s] and angle [deg]; # begins a comment. Throws Error (Fault::input) with
/// the line.
[[nodiscard]] std::vector<TiltCurve::Knot> read_tilt_file(const std::filesystem::path& path);

}  // namespace velum::lms511
