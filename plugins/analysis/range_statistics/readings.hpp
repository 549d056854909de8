// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <vector>
#include <velum/context.hpp>
#include <velum/values.hpp>

/// The readings of a cloud, in groups that are looked at together.
struct Readings {
  std::vector<double> times;   ///< [s]
  std::vector<double> ranges;  ///< [m]
  double angle = 0.0;          ///< mean angle of the beams [rad], as the scanner counts it
};
using Groups = std::map<std::int64_t, Readings>;

enum class Per { all, beam, label, period };

/// Which points count, and how they are grouped.
struct Choice {
  Per per = Per::all;
  double period = 3600.0;  ///< [s]
  double least = 0.0;      ///< [m]
  double greatest = 0.0;   ///< [m]
  std::vector<int> beams;  ///< empty: all
  std::vector<int> labels;
  bool perpendicular = false;  ///< of all beams only the one with the least mean range
};

/// Throws Error (Fault::stage) where the cloud does not say from where it was seen.
[[nodiscard]] Groups group(const velum::Cloud& cloud, const Choice& choice,
                           velum::Context& context);
