// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/bytes.hpp"
#include "run/json.hpp"
#include "velum/values.hpp"

namespace velum::report {

/// One column of a view: numbers in 65535 equal steps from `lo` to `hi` (65535 itself: no value),
/// or labels as they are (all bits set: none).
struct ViewColumn {
  std::string name;
  std::string unit;
  bool label = false;
  Bytes data = {};
  double lo = 0.0;
  double hi = 0.0;
  int bits = 16;                        ///< of a label: 16 or 32
  std::vector<std::string> names = {};  ///< of the labels from 0 on, where they have names
};

/// How many values of a column lie in each of equal bins from `lo` to `hi`, and outside.
struct Histogram {
  std::string name;
  std::string unit;
  std::string better;  ///< "lower", "higher" or ""
  double lo = 0.0;
  double hi = 0.0;
  std::vector<std::uint64_t> counts;
  std::uint64_t below = 0;
  std::uint64_t above = 0;
};

/// What the page shows of one value: positions and columns in 16 bits, tables as they are.
struct View {
  std::string node;
  std::string output;
  std::string variant;    ///< of a study; else empty
  std::size_t order = 0;  ///< values further upstream come first
  ValueType type = ValueType::cloud;
  std::uint64_t count = 0;  ///< points, vertices or rows of the value
  std::uint64_t shown = 0;  ///< of them in the view
  /// Position i is origin + lo + q / 65535 (hi - lo), q the i-th triple of `positions` [m].
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d lo = Eigen::Vector3d::Zero();
  Eigen::Vector3d hi = Eigen::Vector3d::Zero();
  Bytes positions;
  Bytes triangles;  ///< three indices each, of `index_bits`
  int index_bits = 16;
  Bytes::Key group;   ///< of `positions` before any thinning
  int thinned = 0;    ///< how often
  double cell = 0.0;  ///< edge of the grid on which vertices were merged [m]; 0: they were not
  std::vector<ViewColumn> columns;
  std::vector<Sensor> sensors;
  run::Json rows;    ///< null: none
  run::Json matrix;  ///< null: none
  std::vector<Histogram> histograms;

  [[nodiscard]] std::string id() const {
    return (variant.empty() ? "" : variant + "/") + node + "." + output;
  }
};

inline constexpr std::uint16_t kNoNumber = 65535;
inline constexpr double kPositionSteps = 65535.0;
inline constexpr double kNumberSteps = 65534.0;
/// Rows and cells of a table that are shown; larger ones are thinned.
inline constexpr std::size_t kMostRows = 5'000;
inline constexpr std::size_t kMostTableCells = 50'000;

/// Throws what a stage may throw of a value that is not sound.
[[nodiscard]] View make_view(const Value& value);

/// The view with about half as many points; nothing when so few are left that it is not worth it.
[[nodiscard]] std::optional<View> thinner(const View& view);

/// The indices of triangles as 32 bits each.
[[nodiscard]] std::vector<std::uint32_t> indices_of(const View& view);
/// Puts triangles in, in as few bits as their indices need.
void set_triangles(View& view, const std::vector<std::uint32_t>& indices);

}  // namespace velum::report
