// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/material.hpp"

#include <algorithm>
#include <array>

namespace velum::scene {
namespace {

struct Known {
  std::string_view name;
  Material material;
};

// Spreads: reflective 3.3 and sail 4.1 mm are stated in 2.4.3.3, wood is the mean of what 2.4.3.1,
// 2.4.3.2 and 2.4.3.6 found on the wooden target; figure 2.17 puts the other three between and
// prints no numbers. Films: table 2.2, whose offsets include the error of 5.4 mm that the scanner
// has at 2 m on any target (see error_model.hpp); what is left is the film's. Remissions are those
// that data sheets give for such surfaces, the transmission of sail cloth is a guess after figure
// 2.18: the thesis has no numbers for them.
constexpr std::array<Known, 11> kKnown{{
    {"wood", {.noise = 0.0039, .remission = 0.6}},
    {"cardboard", {.noise = 0.0038, .remission = 0.5}},
    {"aluminium", {.noise = 0.0036, .remission = 1.2}},
    {"plastic", {.noise = 0.0037, .remission = 0.7}},
    {"reflective", {.noise = 0.0033, .remission = 3.0}},
    {"sail", {.noise = 0.0041, .remission = 0.5, .transmission = 0.03}},
    {"green", {.noise = 0.0038, .offset = -0.0076, .remission = 0.5}},
    {"yellow", {.noise = 0.0038, .offset = -0.0001, .remission = 0.8}},
    {"black", {.noise = 0.0039, .offset = -0.0001, .remission = 0.1}},
    {"light_gray", {.noise = 0.0037, .offset = -0.0077, .remission = 0.7}},
    {"dark_gray", {.noise = 0.0040, .offset = 0.0093, .remission = 0.2}},
}};

}  // namespace

std::optional<Material> known_material(std::string_view name) {
  const auto* found =
      std::find_if(kKnown.begin(), kKnown.end(), [&](const Known& k) { return k.name == name; });
  if (found == kKnown.end()) return std::nullopt;
  return found->material;
}

std::vector<std::string> known_materials() {
  std::vector<std::string> names;
  for (const Known& one : kKnown) names.emplace_back(one.name);
  return names;
}

}  // namespace velum::scene
