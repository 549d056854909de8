// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "readings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace {

using velum::Cloud;
using velum::Index;

template <class T>
std::span<const T> values(const Cloud& cloud, const char* name) {
  if (!cloud.has(name)) return {};
  const auto column = cloud.column(name).vector<T>();
  return {column.data(), static_cast<std::size_t>(column.size())};
}

// The columns of a cloud that readings are made of, and what holds where one is missing.
class Source {
 public:
  explicit Source(const Cloud& cloud)
      : cloud_(cloud),
        times_(values<double>(cloud, velum::column::kTime)),
        lines_(values<std::int32_t>(cloud, velum::column::kLine)),
        beams_(values<std::int32_t>(cloud, velum::column::kBeam)),
        labels_(values<std::int32_t>(cloud, velum::column::kLabel)) {
    if (cloud.sensors().empty() && !cloud.empty())
      throw velum::Error(velum::Fault::stage, "the cloud does not say where its scanner stood")
          .hint(
              "ranges are distances from the scanner: use a cloud from devices.* or one whose "
              "file keeps the sensor");
  }
  [[nodiscard]] bool timed() const { return !times_.empty() || cloud_.empty(); }
  // Without times the number of the line, without lines that of the point.
  [[nodiscard]] double time(Index i) const {
    const auto at = static_cast<std::size_t>(i);
    if (!times_.empty()) return times_[at];
    return lines_.empty() ? static_cast<double>(i) : lines_[at];
  }
  [[nodiscard]] int beam(Index i) const {
    return beams_.empty() ? 0 : beams_[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] int label(Index i) const {
    return labels_.empty() ? 0 : labels_[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] double first_time() const {
    return times_.empty() ? 0.0 : *std::min_element(times_.begin(), times_.end());
  }
  // In the frame of the scanner that saw the point.
  [[nodiscard]] Eigen::Vector3d seen(Index i) const {
    const auto& sensor = cloud_.sensors()[cloud_.sensor_of(i).value_or(0)];
    return sensor.pose.inverse() * (cloud_.origin() + cloud_.positions().col(i).cast<double>());
  }

 private:
  const Cloud& cloud_;
  std::span<const double> times_;
  std::span<const std::int32_t> lines_;
  std::span<const std::int32_t> beams_;
  std::span<const std::int32_t> labels_;
};

bool wanted(const std::vector<int>& list, int value) {
  return list.empty() || std::find(list.begin(), list.end(), value) != list.end();
}

// The beam with the least mean range, of those that have at least half as many readings as any.
std::optional<std::int64_t> nearest_beam(const std::map<std::int64_t, Readings>& beams) {
  std::size_t most = 0;
  for (const auto& [beam, readings] : beams) most = std::max(most, readings.ranges.size());
  std::optional<std::int64_t> best;
  double least = 0.0;
  for (const auto& [beam, readings] : beams) {
    if (2 * readings.ranges.size() < most) continue;
    double sum = 0.0;
    for (const double range : readings.ranges) sum += range;
    const double mean = sum / static_cast<double>(readings.ranges.size());
    if (best && mean >= least) continue;
    best = beam;
    least = mean;
  }
  return best;
}

template <class Key>
Groups collect(const Source& source, Index count, const Choice& choice, const Key& key,
               velum::Context& context) {
  Groups groups;
  for (Index i = 0; i < count; ++i) {
    if (i % 4096 == 0) context.check();
    if (!wanted(choice.beams, source.beam(i)) || !wanted(choice.labels, source.label(i))) continue;
    const Eigen::Vector3d seen = source.seen(i);
    const double range = seen.norm();
    if (range < choice.least || range > choice.greatest) continue;
    Readings& own = groups[key(i)];
    own.times.push_back(source.time(i));
    own.ranges.push_back(range);
    // From the x axis in the plane of the line, which the tilt turns about x.
    const double up = std::hypot(seen.y(), seen.z());
    own.angle += std::atan2(seen.y() < 0.0 ? -up : up, seen.x());
  }
  for (auto& [number, own] : groups) own.angle /= static_cast<double>(own.ranges.size());
  return groups;
}

}  // namespace

Groups group(const Cloud& cloud, const Choice& choice, velum::Context& context) {
  const Source source(cloud);
  const auto by_beam = [&](Index i) { return source.beam(i); };
  Choice chosen = choice;
  if (choice.perpendicular) {
    const auto best = nearest_beam(collect(source, cloud.size(), choice, by_beam, context));
    if (best) chosen.beams = {static_cast<int>(*best)};
  }
  if (choice.per == Per::period && !source.timed())
    throw velum::Error(velum::Fault::stage, "the cloud has no column 'time', which periods need")
        .hint("devices.simulator gives times where the scanner's `period` is set");
  const double start = source.first_time();
  const auto key = [&](Index i) -> std::int64_t {
    if (chosen.per == Per::beam) return source.beam(i);
    if (chosen.per == Per::label) return source.label(i);
    if (chosen.per == Per::period)
      return static_cast<std::int64_t>((source.time(i) - start) / chosen.period) + 1;
    return 0;
  };
  return collect(source, cloud.size(), chosen, key, context);
}
