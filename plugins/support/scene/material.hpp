// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace velum::scene {

/// How a surface answers the laser (thesis 2.4.3.3 and 2.4.3.4).
struct Material {
  double noise = 0.004;       ///< standard deviation of a range on it [m]
  double offset = 0.0;        ///< mean error that it adds to a range [m]
  double remission = 1.0;     ///< light that it sends back; 1: a white, matt surface
  double transmission = 0.0;  ///< share of pulses that pass through it, 0 to 1
};

/// The materials and colours that the thesis measured: "wood", "cardboard", "aluminium", "plastic",
/// "reflective", "sail", and adhesive films "green", "yellow", "black", "light_gray", "dark_gray".
/// Nothing for any other name.
[[nodiscard]] std::optional<Material> known_material(std::string_view name);
[[nodiscard]] std::vector<std::string> known_materials();

}  // namespace velum::scene
