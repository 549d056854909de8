// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/spline.hpp"

#include <algorithm>
#include <cstddef>

namespace velum::scene {

Spline::Spline(std::vector<double> x, std::vector<double> y)
    : x_(std::move(x)), y_(std::move(y)), bend_(x_.size(), 0.0) {
  // Tridiagonal system of the second derivatives (Thomas's algorithm), zero at both ends.
  const std::size_t n = x_.size();
  std::vector<double> upper(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = x_[i] - x_[i - 1];
    const double after = x_[i + 1] - x_[i];
    const double load = 6.0 * ((y_[i + 1] - y_[i]) / after - (y_[i] - y_[i - 1]) / before);
    const double pivot = 2.0 * (before + after) - before * upper[i - 1];
    upper[i] = after / pivot;
    bend_[i] = (load - before * bend_[i - 1]) / pivot;
  }
  for (std::size_t i = n; i-- > 1;) bend_[i - 1] -= upper[i - 1] * bend_[i];
}

double Spline::slope(std::size_t node) const {
  const std::size_t a = node == 0 ? 0 : node - 1;
  const double h = x_[a + 1] - x_[a];
  const double secant = (y_[a + 1] - y_[a]) / h;
  return node == 0 ? secant - h * (2.0 * bend_[a] + bend_[a + 1]) / 6.0
                   : secant + h * (bend_[a] + 2.0 * bend_[a + 1]) / 6.0;
}

double Spline::operator()(double x) const {
  const std::size_t last = x_.size() - 1;
  if (last == 0) return y_[0];
  if (x <= x_[0]) return y_[0] + slope(0) * (x - x_[0]);
  if (x >= x_[last]) return y_[last] + slope(last) * (x - x_[last]);
  const auto i = static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin());
  const double h = x_[i] - x_[i - 1];
  const double a = (x_[i] - x) / h;
  const double b = 1.0 - a;
  return a * y_[i - 1] + b * y_[i] +
         h * h / 6.0 * ((a * a * a - a) * bend_[i - 1] + (b * b * b - b) * bend_[i]);
}

}  // namespace velum::scene
