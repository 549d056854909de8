// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "bspline/refine.hpp"

namespace velum::bspline {
namespace {

// Control points of one direction as rows, those of the other as blocks of three columns.
Eigen::MatrixXd inserted(const Eigen::MatrixXd& rows, const Eigen::VectorXd& knots, int degree,
                         double at) {
  Index span = degree;
  while (span + 1 < rows.rows() && knots[span + 1] <= at) ++span;
  Eigen::MatrixXd more(rows.rows() + 1, rows.cols());
  for (Index i = 0; i < more.rows(); ++i) {
    if (i <= span - degree) {
      more.row(i) = rows.row(i);
    } else if (i > span) {
      more.row(i) = rows.row(i - 1);
    } else {
      const double share = (at - knots[i]) / (knots[i + degree] - knots[i]);
      more.row(i) = share * rows.row(i) + (1.0 - share) * rows.row(i - 1);
    }
  }
  return more;
}

}  // namespace

void insert_knot(Surface& surface, Along along, double at) {
  const bool u = along == Along::u;
  const Index count_u = count_of(surface.knots_u, surface.degree_u);
  const Index count_v = count_of(surface.knots_v, surface.degree_v);
  const Index rows = u ? count_u : count_v;
  const Index others = u ? count_v : count_u;
  const auto column = [&](Index row, Index other, Index others_v) {
    return u ? row * others_v + other : other * others_v + row;
  };
  Eigen::MatrixXd control(rows, 3 * others);
  for (Index r = 0; r < rows; ++r)
    for (Index o = 0; o < others; ++o)
      control.block<1, 3>(r, 3 * o) = surface.control.col(column(r, o, count_v)).transpose();
  Eigen::VectorXd& knots = u ? surface.knots_u : surface.knots_v;
  const Eigen::MatrixXd more =
      inserted(control, knots, u ? surface.degree_u : surface.degree_v, at);
  surface.control.resize(3, (rows + 1) * others);
  const Index next_v = u ? count_v : count_v + 1;
  for (Index r = 0; r <= rows; ++r)
    for (Index o = 0; o < others; ++o)
      surface.control.col(column(r, o, next_v)) = more.block<1, 3>(r, 3 * o).transpose();
  Eigen::VectorXd longer(knots.size() + 1);
  Index place = 0;
  while (place < knots.size() && knots[place] <= at) ++place;
  longer << knots.head(place), at, knots.tail(knots.size() - place);
  knots = std::move(longer);
}

}  // namespace velum::bspline
