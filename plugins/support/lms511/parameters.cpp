// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/parameters.hpp"

#include <fmt/format.h>

namespace velum::lms511 {
namespace {

std::optional<double> plain(const std::optional<Angle>& angle) {
  return angle ? std::optional<double>(angle->radians) : std::nullopt;
}

}  // namespace

void SweepParameters::check_sweep() const {
  sweep().tilt.check();
  constexpr std::size_t kTurns = 3;
  if (!misalignment.empty() && misalignment.size() != kTurns)
    throw Error(Fault::graph, fmt::format("found {} angles, expected three: about x, y and z",
                                          misalignment.size()))
        .at("misalignment");
}

SweepSettings SweepParameters::sweep() const {
  SweepSettings settings;
  settings.tilt = {.source = tilt,
                   .start = tilt_start,
                   .end = plain(tilt_end),
                   .speed = plain(tilt_speed),
                   .acceleration = plain(tilt_acceleration),
                   .counts = encoder_counts,
                   .zero = encoder_zero,
                   .file = tilt_file.path};
  settings.mounting = mounting;
  settings.calibration.lever = lever_arm.metres;
  for (std::size_t i = 0; i < misalignment.size() && i < 3; ++i)
    settings.calibration.misalignment[static_cast<Index>(i)] = misalignment[i];
  settings.calibration.time_offset = time_offset;
  settings.echoes = echoes;
  settings.range_min = range_min;
  settings.range_max = range_max;
  settings.name = sensor;
  return settings;
}

void report(const LineGatherer& lines, const SweepCounts& counts, Context& context) {
  const LineCounts& seen = lines.counts();
  const auto count = [&](const char* name, std::uint64_t value, Better better = Better::neither) {
    context.measure(name, static_cast<double>(value), "", better);
  };
  count("lines", seen.lines);
  count("lost_lines", seen.lost, Better::lower);
  count("malformed", seen.malformed, Better::lower);
  count("returns", seen.returns.ranges);
  count("no_return", seen.returns.none);
  count("dazzled", seen.returns.dazzled);
  count("implausible", seen.returns.implausible);
  count("reserved", seen.returns.reserved);
  count("gaps", seen.gaps, Better::lower);
  count("untilted", counts.untilted, Better::lower);
  context.measure("span", counts.span, "s");
  if (lines.trigger()) context.measure("skew", counts.skew, "s", Better::lower);
  if (seen.lost > 0)
    context.warn(fmt::format("{} revolutions are missing: the scan counter jumped", seen.lost));
  if (seen.malformed > 0)
    context.warn(
        fmt::format("{} scans contradict themselves or the device, left out", seen.malformed));
  if (seen.unusable > 0)
    context.info(
        fmt::format("{} scans made with the laser off or a device error, left out", seen.unusable));
  if (counts.untilted > 0)
    context.warn(
        fmt::format("{} returns at times whose tilt is not known, left out", counts.untilted));
  for (const std::string& gap : lines.gaps()) context.warn("gap: " + gap);
}

}  // namespace velum::lms511
