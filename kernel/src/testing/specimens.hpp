// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "velum/about.hpp"

namespace velum::test {

/// A set of points on which stages are tried, with what it takes to make every type of value of it.
struct Specimen {
  std::string name;  ///< as in "with 3 points: ..."
  Cloud cloud;       ///< has every known column that has a meaning for all clouds, and a sensor
  /// Columns of a grid when the points are one, row by row; else 0.
  Index grid = 0;
};

/// A curved sheet of 24×24 points, 1 m wide, with the first one's columns: what stages are made
/// for.
Specimen sheet();
/// 0 to 3 points, all equal, on a line, in a plane, 1e7 m away, scaled by 1e-6, numbers that are
/// not finite in the columns.
std::vector<Specimen> degenerate_specimens();

/// A value of `type` made of the specimen's points.
Value make_value(ValueType type, const Specimen& specimen);
/// The value with the columns that `port` speaks of, and without others where `spare` is set.
Value fit_to(const Port& port, const Value& value, bool spare);

}  // namespace velum::test
