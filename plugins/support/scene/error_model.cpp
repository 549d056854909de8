// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/error_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "velum/error.hpp"

namespace velum::scene {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kOblique = 70.0 * kDegree;

constexpr std::array<std::string_view, kEffects> kNames{"material",     "distance",  "incidence",
                                                        "angulation",   "light",     "mixed_pixels",
                                                        "transparency", "remission", "warm_up"};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

[[noreturn]] void unknown(std::string_view name) {
  std::string known = "none, all";
  for (const auto one : kNames) known.append(", ").append(one);
  throw Error(Fault::graph, "'" + std::string(name) + "' is no effect on ranges")
      .hint("known: " + known);
}

}  // namespace

Effects Effects::named(std::string_view names) {
  Effects effects;
  if (trimmed(names) == "none") return effects;
  if (trimmed(names) == "all") {
    effects.set_.set();
    return effects;
  }
  for (std::size_t at = 0; at <= names.size();) {
    const std::size_t comma = std::min(names.find(',', at), names.size());
    const std::string_view name = trimmed(names.substr(at, comma - at));
    const auto* found = std::find(kNames.begin(), kNames.end(), name);
    if (found == kNames.end()) unknown(name);
    effects.set_.set(static_cast<std::size_t>(found - kNames.begin()));
    at = comma + 1;
  }
  return effects;
}

double distance_error(double range) {
  return std::min(0.0034 + 0.001 * range, 0.0027 * range);
}

double angulation_error(double angle) {
  constexpr double kOffAxis = 0.003;
  constexpr double kFrom = -15.0 * kDegree;  // zero at 75 degrees, between what was measured
  return kOffAxis * std::cos(angle - kFrom);
}

double incidence_spread(double incidence, double spot) {
  constexpr double kSteepest = 89.0 * kDegree;
  constexpr double kShare = 0.1;
  if (incidence <= kOblique) return 0.0;
  return kShare * spot * (std::tan(std::min(incidence, kSteepest)) - std::tan(kOblique));
}

double incidence_loss(double incidence) {
  const double beyond = std::max(0.0, incidence - kOblique) / (0.5 * std::numbers::pi - kOblique);
  return std::min(1.0, beyond * beyond);
}

double glare(Sunlight sunlight, double away, double width) {
  if (sunlight == Sunlight::none) return 1.0;
  const double most = sunlight == Sunlight::direct ? 3.5 : 0.5;
  return 1.0 + most * std::exp(-0.5 * (away / width) * (away / width));
}

double signal(double range, double incidence, double remission) {
  return remission * std::cos(incidence) / (range * range);
}

double warm_up_error(double hours) {
  constexpr double kAtStart = 0.0016;
  constexpr double kDecay =
      0.514;  // [h]: the second hour's mean excess is a seventh of the first's
  return kAtStart * std::exp(-hours / kDecay);
}

}  // namespace velum::scene
