// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <limits>
#include <velum/stage.hpp>

#include "geometry/selection.hpp"

namespace {

enum class Keep { inside, outside };

/// Everywhere, unless bounds are set.
struct Box {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Eigen::Array3d low = Eigen::Array3d::Constant(-kInfinity);
  Eigen::Array3d high = Eigen::Array3d::Constant(kInfinity);

  // All six are compared, which is faster than to branch on each where points come in any order.
  [[nodiscard]] bool holds(const Eigen::Vector3d& place) const {
    return (place.array() >= low).count() + (place.array() <= high).count() == 6;
  }
};

struct RegionOfInterest {
  std::optional<velum::Place> min;
  std::optional<velum::Place> max;
  std::optional<velum::Place> centre;
  std::optional<velum::Length> radius;
  std::optional<velum::Length> min_range;
  std::optional<velum::Length> max_range;
  Keep keep = Keep::inside;

  static auto about() {
    return velum::About<RegionOfInterest>(
               "Keeps, or removes, the points of a box, a ball or a span of ranges.")
        .in("cloud")
        .out("cloud")
        .param(&RegionOfInterest::min, "min", "lowest corner of a box, in the cloud's frame")
        .param(&RegionOfInterest::max, "max", "highest corner of a box")
        .param(&RegionOfInterest::centre, "centre", "centre of a ball, in the cloud's frame")
        .param(&RegionOfInterest::radius, "radius", "radius of the ball", velum::above(0.0))
        .param(&RegionOfInterest::min_range, "min_range",
               "least distance from the sensor that saw the point", velum::at_least(0.0))
        .param(&RegionOfInterest::max_range, "max_range",
               "greatest distance from the sensor that saw the point", velum::above(0.0))
        .choice(&RegionOfInterest::keep, "keep", "which side stays",
                {{"inside", Keep::inside, "what lies within all that is given"},
                 {"outside", Keep::outside, "everything else"}})
        .deterministic();
  }

  void check() const {
    if (centre.has_value() != radius.has_value())
      throw velum::Error(velum::Fault::graph, "a ball needs both 'centre' and 'radius'")
          .at(centre ? "centre" : "radius");
    if (!min && !max && !centre && !min_range && !max_range)
      throw velum::Error(velum::Fault::graph, "no region is given")
          .hint("give min and max, centre and radius, or min_range and max_range");
    if (min && max && (min->metres.array() > max->metres.array()).any())
      throw velum::Error(velum::Fault::graph, "the box has a 'min' above its 'max'").at("min");
  }

  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    context.check();
    require_sensor(cloud);
    std::vector<Eigen::Vector3d> sensors;
    for (const velum::Sensor& sensor : cloud.sensors())
      sensors.push_back(sensor.pose.translation());
    const auto positions = cloud.positions();
    const Box box = box_given();
    std::vector<std::uint8_t> kept(static_cast<std::size_t>(cloud.size()));
    velum::parallel_for(context, cloud.size(), 16384, [&](velum::Index begin, velum::Index end) {
      for (velum::Index i = begin; i < end; ++i) {
        const Eigen::Vector3d place = cloud.origin() + positions.col(i).cast<double>();
        bool inside = box.holds(place);
        if (inside && centre) inside = in_ball(place);
        if (inside && (min_range || max_range))
          inside = in_range((place - sensors[cloud.sensor_of(i).value_or(0)]).norm());
        kept[static_cast<std::size_t>(i)] = inside == (keep == Keep::inside);
      }
    });
    return velum::geometry::keep_points(cloud, kept, context);
  }

 private:
  void require_sensor(const velum::Cloud& cloud) const {
    if ((min_range || max_range) && cloud.sensors().empty() && !cloud.empty())
      throw velum::Error(velum::Fault::stage, "a range was asked for, but the cloud has no sensor")
          .hint("use a box or a ball, or a file format that carries the sensor's pose");
  }
  // Borders belong to the region.
  [[nodiscard]] Box box_given() const {
    Box box;
    if (min) box.low = min->metres;
    if (max) box.high = max->metres;
    return box;
  }
  [[nodiscard]] bool in_ball(const Eigen::Vector3d& place) const {
    return (place - centre->metres).norm() <= *radius;
  }
  [[nodiscard]] bool in_range(double range) const {
    return (!min_range || range >= *min_range) && (!max_range || range <= *max_range);
  }
};

}  // namespace
VELUM_STAGE(RegionOfInterest)
