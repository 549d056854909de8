// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <velum/stage.hpp>

#include "geometry/selection.hpp"
#include "geometry/viewpoint.hpp"

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

enum class Action { remove, mark };

struct Incidence {
  velum::Angle angle = {70.0 * kDegree};
  Action action = Action::remove;

  static auto about() {
    return velum::About<Incidence>(
               "Removes or marks returns whose ray meets the surface at a grazing angle.")
        .in("cloud")
        .needs("cloud", "normals")
        .out("cloud", "with the angle of incidence of each return, 0 for head on")
        .adds("cloud", "incidence")
        .param(&Incidence::angle, "angle",
               "greatest angle between ray and normal at which a range is still good",
               velum::between(0.0, std::numbers::pi / 2))
        .choice(&Incidence::action, "action", "what becomes of the returns beyond it",
                {{"remove", Action::remove, "they go"},
                 {"mark", Action::mark, "they stay; the column `grazing` is 1 for them, else 0"}})
        .deterministic()
        .reference("thesis 2.4.3.5: the spread of ranges grows sharply beyond 70 degrees");
  }

  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    context.check();
    const Eigen::VectorXf angles = measure(cloud, context);
    velum::VectorXu8 grazing(cloud.size());
    // The angle itself is still good, whatever rounding made of it.
    const auto limit = static_cast<float>(angle + 1e-6);
    for (velum::Index i = 0; i < cloud.size(); ++i) grazing[i] = angles[i] > limit ? 1 : 0;
    context.measure("grazing", static_cast<double>(grazing.cast<int>().sum()), "");
    context.measure("largest", cloud.empty() ? 0.0 : static_cast<double>(angles.maxCoeff()), "rad");
    std::vector<std::uint8_t> keep(static_cast<std::size_t>(cloud.size()));
    for (std::size_t i = 0; i < keep.size(); ++i)
      keep[i] = action == Action::mark || grazing[static_cast<velum::Index>(i)] == 0;
    velum::Cloud out = cloud.with("incidence", velum::Column(angles));
    if (action == Action::mark) out = out.with("grazing", velum::Column(std::move(grazing)));
    return velum::geometry::keep_points(out, keep, context);
  }

 private:
  // 0 to 90 degrees: a normal and its opposite are one. A point at the sensor itself has no ray,
  // and none meets it at an angle: 0.
  static Eigen::VectorXf measure(const velum::Cloud& cloud, velum::Context& context) {
    Eigen::VectorXf angles(cloud.size());
    const auto normals = cloud.normals();
    const velum::geometry::Viewpoints viewpoints(cloud);
    velum::parallel_for(context, cloud.size(), 8192, [&](velum::Index begin, velum::Index end) {
      context.check();
      for (velum::Index i = begin; i < end; ++i) {
        const Eigen::Vector3d ray = viewpoints.from(i);
        const Eigen::Vector3d normal = normals.col(i).cast<double>();
        // Sine and cosine together are accurate at all angles. A normal that is not finite says
        // nothing against the point.
        if (!normal.allFinite()) {
          angles[i] = 0.0F;
          continue;
        }
        angles[i] =
            static_cast<float>(std::atan2(ray.cross(normal).norm(), std::abs(ray.dot(normal))));
      }
    });
    return angles;
  }
};

}  // namespace
VELUM_STAGE(Incidence)
