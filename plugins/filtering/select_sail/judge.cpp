// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sheet.hpp"

namespace velum::sails {
namespace {

// 0.5 at the limit, 1 from twice as good on, 0 from half as good down.
double at_least(double value, double limit) {
  if (!(limit > 0.0)) return 1.0;
  if (!(value > 0.0)) return 0.0;
  return std::clamp(0.5 + 0.5 * std::log2(value / limit), 0.0, 1.0);
}
double at_most(double value, double limit) {
  if (!(value > 0.0)) return 1.0;
  return at_least(limit, value);
}

// The weakest point decides: a wall is no sail for being large.
class Weakest {
 public:
  void demand(double score, std::string reason) {
    if (score >= verdict_.score) return;
    verdict_.score = score;
    verdict_.reason = std::move(reason);
  }
  [[nodiscard]] Verdict verdict() const { return verdict_; }

 private:
  Verdict verdict_{1.0, {}};
};

double degrees(double radians) {
  return radians * 57.29577951308232;
}

}  // namespace

Verdict judge(const Sheet& sheet, const Demands& demands) {
  if (!(sheet.width > 0.0) || !(sheet.area > 0.0))
    return {0.0, "too few points, or points on a line"};
  Weakest weakest;
  weakest.demand(at_least(sheet.area, demands.min_area),
                 fmt::format("small: {:.3g} m² of at least {:.3g}", sheet.area, demands.min_area));
  if (demands.max_area)
    weakest.demand(
        at_most(sheet.area, *demands.max_area),
        fmt::format("large: {:.3g} m² of at most {:.3g}", sheet.area, *demands.max_area));
  weakest.demand(at_most(sheet.lean, demands.max_lean),
                 fmt::format("lies flat: leans {:.0f}° of at most {:.0f}°", degrees(sheet.lean),
                             degrees(demands.max_lean)));
  weakest.demand(at_least(sheet.aspect(), demands.min_aspect),
                 fmt::format("wide: {:.2f} times as high as wide, at least {:.2f}", sheet.aspect(),
                             demands.min_aspect));
  weakest.demand(at_most(sheet.aspect(), demands.max_aspect),
                 fmt::format("thin: {:.1f} times as high as wide, at most {:.1f}", sheet.aspect(),
                             demands.max_aspect));
  // What bends no more than it is rough is flat, whatever its noise.
  const double least_bend = std::max(demands.min_bend * sheet.width, 1.5 * sheet.roughness);
  weakest.demand(at_least(sheet.bend, least_bend),
                 fmt::format("plane: bends by {:.1f} mm RMS, at least {:.1f}", 1e3 * sheet.bend,
                             1e3 * least_bend));
  weakest.demand(at_most(sheet.bend, demands.max_bend * sheet.width),
                 fmt::format("bulky: bends by {:.0f} mm RMS, at most {:.0f}", 1e3 * sheet.bend,
                             1e3 * demands.max_bend * sheet.width));
  weakest.demand(at_most(sheet.roughness, demands.smoothness * sheet.width),
                 fmt::format("rough: {:.1f} mm RMS off a cubic, at most {:.1f}",
                             1e3 * sheet.roughness, 1e3 * demands.smoothness * sheet.width));
  weakest.demand(at_most(sheet.top, demands.max_top),
                 fmt::format("does not taper: its top is {:.2f} of its width, at most {:.2f}",
                             sheet.top, demands.max_top));
  if (demands.near) {
    const double distance = (sheet.centre - *demands.near).norm();
    weakest.demand(
        at_most(distance, demands.within),
        fmt::format("far: {:.2f} m from the hint, at most {:.2f}", distance, demands.within));
  }
  Verdict verdict = weakest.verdict();
  if (verdict.sail()) {
    const std::string figures = verdict.reason.substr(verdict.reason.find(':') + 1);
    verdict.reason = "upright, smooth, curved, tapers to its top";
    if (verdict.score < 1.0) verdict.reason += "; nearest to a limit:" + figures;
  }
  return verdict;
}

}  // namespace velum::sails
