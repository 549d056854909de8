// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <vector>
#include <velum/about.hpp>

#include "lms511/sweep.hpp"

/// Parameters that the stages which make clouds of lines have in common.
namespace velum::lms511 {

/// Bases of a stage that has these parameters.
struct SweepParameters {
  TiltSource tilt = TiltSource::fixed;
  Angle tilt_start;
  std::optional<Angle> tilt_end;
  std::optional<Angle> tilt_speed;
  std::optional<Angle> tilt_acceleration;
  double encoder_counts = 0.0;
  double encoder_zero = 0.0;
  InputFile tilt_file;
  Mounting mounting = Mounting::plate;
  Place lever_arm;
  std::vector<Angle> misalignment;
  Duration time_offset;
  Echoes echoes = Echoes::all;
  Length range_min = 0.0;
  Length range_max = 100.0;
  std::string sensor = "lms511";

  /// Throws Error (Fault::graph) at the parameter.
  void check_sweep() const;
  [[nodiscard]] SweepSettings sweep() const;
};

/// Describes SweepParameters; also the columns of `cloud`.
template <class Stage>
void add_sweep(AboutStage& about) {
  const auto own = []<class M>(M SweepParameters::*member) -> M Stage::* { return member; };
  for (const char* column :
       {column::kBeam, column::kLine, column::kTilt, column::kTime, "range", column::kSensor})
    about.adds("cloud", column);
  about
      .choice(own(&SweepParameters::tilt), "tilt", "where the tilt of a beam comes from",
              {{"fixed", TiltSource::fixed, "tilt_start throughout"},
               {"constant", TiltSource::constant,
                "from tilt_start at tilt_speed; without a speed tilt_end is reached with the last "
                "line"},
               {"trapezoid", TiltSource::trapezoid,
                "from tilt_start to tilt_end, gaining and losing speed evenly"},
               {"encoder", TiltSource::encoder, "the encoder whose count is in each telegram"},
               {"file", TiltSource::file, "tilt_file: times and angles"},
               {"feed", TiltSource::feed, "angles that arrived with the telegrams"}})
      .param(own(&SweepParameters::tilt_start), "tilt_start", "tilt when the sweep begins")
      .param(own(&SweepParameters::tilt_end), "tilt_end", "tilt when the sweep ends")
      .param(own(&SweepParameters::tilt_speed), "tilt_speed", "angle a second")
      .param(own(&SweepParameters::tilt_acceleration), "tilt_acceleration",
             "of the trapezoidal law: angle a second, a second", above(0.0))
      .param(own(&SweepParameters::encoder_counts), "encoder_counts",
             "counts of the encoder for one turn; negative where it counts backwards")
      .param(own(&SweepParameters::encoder_zero), "encoder_zero", "the encoder's count at tilt 0")
      .param(own(&SweepParameters::tilt_file), "tilt_file",
             "lines of time [s since the sweep began] and angle [deg]")
      .choice(own(&SweepParameters::mounting), "mounting", "what the scanner is turned about",
              {{"plate", Mounting::plate, "its x axis, across the view"},
               {"turntable", Mounting::turntable, "its 90-degree direction, which stands upright"}})
      .param(own(&SweepParameters::lever_arm), "lever_arm",
             "where the scanner's origin is at tilt 0, seen from the axis")
      .param(own(&SweepParameters::misalignment), "misalignment",
             "three small turns of the scanner about x, y and z; none: aligned",
             between(-std::numbers::pi, std::numbers::pi))
      .param(own(&SweepParameters::time_offset), "time_offset",
             "added to the start times of lines: where in the revolution the device takes them",
             between(-1.0, 1.0))
      .advanced()
      .choice(own(&SweepParameters::echoes), "echoes", "which echoes of a beam become points",
              {{"all", Echoes::all, "all that the device sent"},
               {"first", Echoes::first, "the nearest"},
               {"last", Echoes::last, "the farthest"}})
      .param(own(&SweepParameters::range_min), "range_min", "nearer returns are left out",
             at_least(0.0))
      .param(own(&SweepParameters::range_max), "range_max", "farther returns are left out",
             above(0.0))
      .param(own(&SweepParameters::sensor), "sensor", "name of the scanner in the cloud");
}

/// What lines and sweep hold, as measures and warnings.
void report(const LineGatherer& lines, const SweepCounts& counts, Context& context);

}  // namespace velum::lms511
