// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace velum::scene {

/// Natural cubic spline through given nodes: twice continuously differentiable, and a straight line
/// beyond both ends (a constant for a single node).
class Spline {
 public:
  /// `x` strictly ascending, at least one node, as many values as nodes.
  Spline(std::vector<double> x, std::vector<double> y);
  [[nodiscard]] double operator()(double x) const;

 private:
  [[nodiscard]] double slope(std::size_t node) const;

  std::vector<double> x_;
  std::vector<double> y_;
  std::vector<double> bend_;  // second derivative at each node
};

}  // namespace velum::scene
