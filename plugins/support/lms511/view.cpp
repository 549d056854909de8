// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace velum::lms511 {
namespace {

constexpr std::size_t kWidth = 61;
constexpr std::size_t kHeight = 13;
constexpr std::size_t kBins = 60;

// The ranges of a line [m].
std::vector<double> ranges_of(const Line& line) {
  std::vector<double> ranges;
  if (line.ranges.empty()) return ranges;
  const Channel& channel = line.ranges.front();
  for (const std::uint16_t value : channel.values)
    ranges.push_back(value < kLeastRange
                         ? 0.0
                         : 1e-3 * (double{channel.scale} * value + double{channel.offset}));
  return ranges;
}

std::string histogram(const std::vector<double>& ranges, double reach) {
  std::array<std::size_t, kBins> bins{};
  for (const double range : ranges)
    if (range > 0.0)
      ++bins.at(std::min(kBins - 1, static_cast<std::size_t>(range / reach * kBins)));
  const std::size_t most = std::max<std::size_t>(1, *std::max_element(bins.begin(), bins.end()));
  constexpr std::string_view kShades = " .:-=+*#@";
  std::string text;
  for (const std::size_t bin : bins)
    text += kShades[(bin * (kShades.size() - 1) + most - 1) / most];
  return text;
}

// The scanner is the o at the bottom.
std::string side_view(const Line& line, const std::vector<double>& ranges, double reach) {
  std::vector<std::string> rows(kHeight, std::string(kWidth, ' '));
  const double start = true_start(line.ranges.front().start);
  const double step = true_step(line.ranges.front().step);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (ranges[i] <= 0.0) continue;
    const double angle = start + step * static_cast<double>(i);
    const double x = ranges[i] * std::cos(angle) / reach;
    const double y = std::max(0.0, ranges[i] * std::sin(angle) / reach);
    const auto column = std::lround((0.5 + 0.5 * x) * (kWidth - 1));
    const auto row = std::lround((1.0 - y) * (kHeight - 1));
    if (column >= 0 && column < static_cast<long>(kWidth) && row >= 0)
      rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = '#';
  }
  rows.back()[kWidth / 2] = 'o';
  std::string text;
  for (const std::string& row : rows) text += fmt::format("  |{}|\n", row);
  return text;
}

}  // namespace

void LiveView::see(const Line& line) {
  last_ = line;
}

std::string LiveView::draw(const LineCounts& counts, double seconds, double share,
                           std::uint64_t bytes) {
  const double elapsed = std::max(seconds - seconds_before_, 1e-9);
  const double rate = static_cast<double>(counts.lines - lines_before_) / elapsed;
  lines_before_ = counts.lines;
  seconds_before_ = seconds;
  std::string text = fmt::format("{}\n", kViewMark);
  text +=
      fmt::format("  {:.1f} s  {} lines  {:.1f} lines/s  {} lost  {} gaps  {:.1f} MB  {:.0f} %\n",
                  seconds, counts.lines, rate, counts.lost, counts.gaps,
                  1e-6 * static_cast<double>(bytes), 100.0 * std::clamp(share, 0.0, 1.0));
  const std::vector<double> ranges = ranges_of(last_);
  if (ranges.empty()) return text + "  no line yet\n";
  std::vector<double> sorted = ranges;
  std::sort(sorted.begin(), sorted.end());
  const double reach = std::max(0.5, 1.05 * sorted[sorted.size() * 98 / 100]);
  text += side_view(last_, ranges, reach);
  text += fmt::format("  |{} | ranges, 0 to {:.1f} m\n", histogram(ranges, reach), reach);
  return text;
}

}  // namespace velum::lms511
