// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <velum/context.hpp>
#include <velum/table.hpp>

/// How far one shape is from another, point by point: figures and histograms.
namespace velum::deviation {

struct Statistics {
  double mean = 0.0;
  double rms = 0.0;
  double median = 0.0;
  double p95 = 0.0;
  double max = 0.0;
};

/// All zero for no values.
Statistics statistics(const Eigen::VectorXf& values);

/// Records `prefix` + mean, rms, median, p95 and max.
void report(const Statistics& found, const std::string& prefix, const std::string& unit,
            Context& context);

/// A table with the columns `quantity`, `unit`, `from`, `to`, `points` and `share` [%].
Table histogram_table();
/// Adds a row for each of `bins` equal ranges from 0 to the greatest value (to `limit` where that
/// is greater than 0; the last range then holds all beyond it).
void add_histogram(Table& table, const std::string& quantity, const std::string& unit,
                   const Eigen::VectorXf& values, int bins, double limit);

}  // namespace velum::deviation
