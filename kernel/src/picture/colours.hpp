// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "picture/image.hpp"

namespace velum::picture {

/// For 0 to 1: from dark blue over green to light yellow, ever lighter, so that it can be read in
/// grey and by those who do not tell red from green.
[[nodiscard]] Colour colour_of(double share);
/// Of the label with this number; neighbouring numbers look different.
[[nodiscard]] Colour colour_of_label(std::int64_t label);
/// Of what has no value.
[[nodiscard]] inline Colour no_colour() {
  return {0.72F, 0.72F, 0.74F};
}
/// Of lettering.
[[nodiscard]] inline Colour ink() {
  return {0.13F, 0.14F, 0.17F};
}

}  // namespace velum::picture
