// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/device.hpp"

#include <cstdlib>

namespace velum::lms511 {

std::optional<Mode> mode_of(std::uint32_t frequency, std::uint32_t resolution) {
  constexpr std::int64_t kRounding = 7;  // 0.166 and 0.167 both mean 1/6
  for (const Mode& mode : kModes)
    if (mode.frequency == frequency &&
        std::abs(std::int64_t{mode.resolution} - std::int64_t{resolution}) <= kRounding)
      return mode;
  return std::nullopt;
}

}  // namespace velum::lms511
