// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "gaps.hpp"
#include "geometry/selection.hpp"

namespace {

struct MixedPixels {
  velum::Length noise = 0.004;
  velum::Length spot = 0.013;
  double growth = 0.0046;

  static auto about() {
    return velum::About<MixedPixels>(
               "Removes points that hang in the gap between two surfaces along their ray.")
        .in("cloud", "as the scanner measured it: raw ranges, not smoothed")
        .out("cloud")
        .out("removed", "the points that were removed")
        .param(&MixedPixels::noise, "noise", "standard deviation of a range", velum::above(0.0))
        .param(&MixedPixels::spot, "spot", "diameter of the laser's spot at the scanner",
               velum::at_least(0.0))
        .param(&MixedPixels::growth, "growth", "growth of that diameter per metre of range",
               velum::between(0.0, 1.0))
        .deterministic()
        .reference("thesis 2.4.3.8: mixed pixels, which the thesis removed by hand (4.2)");
  }

  std::tuple<velum::Cloud, velum::Cloud> operator()(const velum::Cloud& cloud,
                                                    velum::Context& context) const {
    context.check();
    const std::vector<std::uint8_t> gaps =
        velum::mixed::in_gaps(cloud, {noise, spot, growth}, context);
    std::vector<std::uint8_t> keep(gaps.size());
    std::vector<std::int32_t> removed;
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      keep[i] = gaps[i] == 0 ? 1 : 0;
      if (gaps[i] != 0) removed.push_back(static_cast<std::int32_t>(i));
    }
    return {velum::geometry::keep_points(cloud, keep, context), cloud.select(removed)};
  }
};

}  // namespace
VELUM_STAGE(MixedPixels)
