// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "knots.hpp"

#include <cmath>

namespace velum::meshing {

using bspline::Along;
using Eigen::VectorXd;

namespace {

constexpr double kSeen = 0.25;  // mean residual of a cell that asks for knots / noise
constexpr Index kFewest = 6;    // points of a cell that is heard

// The half span that holds x.
Index cell_of(const VectorXd& knots, int degree, double x) {
  Index span = degree;
  while (span + 1 < bspline::count_of(knots, degree) && knots[span + 1] <= x) ++span;
  const bool upper = x > 0.5 * (knots[span] + knots[span + 1]);
  return 2 * (span - degree) + (upper ? 1 : 0);
}

Index cells_of(const VectorXd& knots, int degree) {
  return 2 * (bspline::count_of(knots, degree) - degree);
}

// Of the residuals in cells of half a span by half a span, u by v; 0 where there are too few.
struct Cells {
  Eigen::MatrixXd squares;  // of the sums, over the variance that noise would give them
  Eigen::MatrixXd means;
  Eigen::MatrixXd heard;  // 1 or 0
};

Cells summed(const FittedSheet& sheet, const VectorXd& weights) {
  const Surface& s = sheet.surface;
  const Index rows = cells_of(s.knots_u, s.degree_u);
  const Index columns = cells_of(s.knots_v, s.degree_v);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(rows, columns);
  Eigen::MatrixXd mass = sum;
  Eigen::MatrixXi count = Eigen::MatrixXi::Zero(rows, columns);
  for (Index i = 0; i < sheet.residual.size(); ++i) {
    const Index a = cell_of(s.knots_u, s.degree_u, sheet.uv(0, i));
    const Index b = cell_of(s.knots_v, s.degree_v, sheet.uv(1, i));
    sum(a, b) += weights[i] * sheet.residual[i];
    mass(a, b) += weights[i];
    ++count(a, b);
  }
  const double noise2 = sheet.noise * sheet.noise;
  const auto heard = count.array() >= kFewest && mass.array() * noise2 > 0.0;
  Cells cells;
  cells.heard = heard.cast<double>();
  cells.squares = heard.select(sum.array().square() / (mass.array() * noise2), 0.0);
  cells.means = heard.select(sum.array() / mass.array(), 0.0);
  return cells;
}

}  // namespace

std::vector<double> spans_to_halve(const FittedSheet& sheet, const VectorXd& weights, Along along) {
  const bool u = along == Along::u;
  const VectorXd& knots = u ? sheet.surface.knots_u : sheet.surface.knots_v;
  const int degree = u ? sheet.surface.degree_u : sheet.surface.degree_v;
  const Cells cells = summed(sheet, weights);
  const auto over_span = [&](const Eigen::MatrixXd& all, Index span) {
    return u ? all.middleRows(2 * span, 2).sum() : all.middleCols(2 * span, 2).sum();
  };
  const Eigen::MatrixXd shapes = cells.means.array().square().matrix();
  std::vector<double> found;
  for (Index k = 0; k < cells_of(knots, degree) / 2; ++k) {
    const double heard = over_span(cells.heard, k);
    const double squares = over_span(cells.squares, k);
    const double shape = over_span(shapes, k);
    const bool structured = heard > 0.0 && squares > heard + 3.0 * std::sqrt(2.0 * heard) &&
                            shape > kSeen * kSeen * heard * sheet.noise * sheet.noise;
    const double low = knots[k + degree];
    const double high = knots[k + degree + 1];
    if (structured && high > low) found.push_back(0.5 * (low + high));
  }
  return found;
}

}  // namespace velum::meshing
