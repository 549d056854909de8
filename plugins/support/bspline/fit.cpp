// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "bspline/fit.hpp"

#include <Eigen/SparseCholesky>
#include <array>
#include <cmath>
#include <limits>

namespace velum::bspline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Triplets = std::vector<Eigen::Triplet<double>>;

// A parameter is dear: cross-validation on few points takes noise for shape (after Kim and Gu,
// Smoothing spline Gaussian regression, 2004, who advise 1.2 to 1.4).
constexpr double kPrice = 1.3;

// ∫ Bᵢ⁽ᵏ⁾ Bⱼ⁽ᵏ⁾ over all spans, by five-point Gauss and Legendre: exact up to degree 4.
MatrixXd gram(const VectorXd& knots, int degree, int derivative) {
  constexpr std::array<double, 5> kAt{-0.9061798459386640, -0.5384693101056831, 0.0,
                                      0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 5> kWeight{0.2369268850561891, 0.4786286704993665,
                                          0.5688888888888889, 0.4786286704993665,
                                          0.2369268850561891};
  const Index count = count_of(knots, degree);
  MatrixXd sum = MatrixXd::Zero(count, count);
  for (Index s = degree; s < count; ++s) {
    const double half = 0.5 * (knots[s + 1] - knots[s]);
    if (!(half > 0.0)) continue;
    for (std::size_t q = 0; q < kAt.size(); ++q) {
      const Basis b = basis(knots, degree, knots[s] + half * (1.0 + kAt[q]), derivative);
      const VectorXd row = b.values.row(derivative);
      sum.block(b.first, b.first, degree + 1, degree + 1) +=
          half * kWeight[q] * row * row.transpose();
    }
  }
  return sum;
}

void add_product(const MatrixXd& u, const MatrixXd& v, double factor, int degree_u, int degree_v,
                 Triplets& out) {
  const Index n = u.rows();
  const Index m = v.rows();
  for (Index i = 0; i < n; ++i)
    for (Index k = std::max<Index>(0, i - degree_u); k <= std::min(n - 1, i + degree_u); ++k)
      for (Index j = 0; j < m; ++j)
        for (Index l = std::max<Index>(0, j - degree_v); l <= std::min(m - 1, j + degree_v); ++l)
          out.emplace_back(static_cast<int>(i * m + j), static_cast<int>(k * m + l),
                           factor * u(i, k) * v(j, l));
}

// Columns z of which the mean of zᵀ X z is the trace of X: those of the identity, or for large
// systems 64 of random signs (Hutchinson, 1990), always the same ones.
struct Probes {
  MatrixXd columns;
  double share = 1.0;
};
Probes probes_for(Index size) {
  constexpr Index kExact = 500;
  constexpr Index kRandom = 64;
  if (size <= kExact) return {MatrixXd::Identity(size, size), 1.0};
  Probes probes{MatrixXd(size, kRandom), 1.0 / static_cast<double>(kRandom)};
  std::uint64_t state = 0x9e3779b97f4a7c15U;
  for (Index i = 0; i < probes.columns.size(); ++i) {
    state ^= state << 13U;
    state ^= state >> 7U;
    state ^= state << 17U;
    probes.columns.data()[i] = (state >> 63U) != 0 ? 1.0 : -1.0;
  }
  return probes;
}

// The penalised problem, solved for one λ after another.
class Problem {
 public:
  Problem(const Sparse& design, const MatrixXd& targets, const VectorXd& weights,
          const Sparse& penalty, const MatrixXd& load)
      : penalty_(penalty), load_(load), rows_(static_cast<double>(targets.size())) {
    const Sparse weighted = weights.asDiagonal() * design;
    normal_ = design.transpose() * weighted;
    right_ = weighted.transpose() * targets;
    total_ = (targets.transpose() * weights.asDiagonal() * targets).trace();
    targets_ = static_cast<double>(targets.cols());
    probes_ = probes_for(normal_.rows());
    response_ = normal_ * probes_.columns;
    scale_ = trace(normal_) / std::max(trace(penalty), 1e-300);
    solver_.analyzePattern(Sparse(normal_ + penalty_));
  }
  [[nodiscard]] double scale() const { return scale_; }

  // False when the system is singular.
  bool solve(double lambda, Smoothed& out) {
    solver_.factorize(Sparse(normal_ + lambda * penalty_));
    if (solver_.info() != Eigen::Success || !(solver_.vectorD().minCoeff() > 0.0)) return false;
    MatrixXd right = right_;
    if (load_.cols() > 0) right -= lambda * load_;
    out.lambda = lambda;
    out.coefficients = solver_.solve(right);
    out.freedom =
        targets_ * probes_.share * probes_.columns.cwiseProduct(solver_.solve(response_)).sum();
    out.squares =
        std::max(0.0, total_ - 2.0 * out.coefficients.cwiseProduct(right_).sum() +
                          out.coefficients.cwiseProduct(normal_ * out.coefficients).sum());
    return out.coefficients.allFinite();
  }
  [[nodiscard]] double score(const Smoothed& fit) const {
    const double left = rows_ - kPrice * fit.freedom;
    return left > 0.0 ? fit.squares / (left * left) : std::numeric_limits<double>::infinity();
  }

 private:
  static double trace(const Sparse& m) { return VectorXd(m.diagonal()).sum(); }
  const Sparse& penalty_;
  const MatrixXd& load_;
  double rows_;
  double targets_ = 1.0;
  double total_ = 0.0;
  double scale_ = 0.0;
  Sparse normal_;
  MatrixXd right_;
  MatrixXd response_;
  Probes probes_;
  Eigen::SimplicialLDLT<Sparse> solver_;
};

}  // namespace

Sparse design(const Surface& grid, const Eigen::Matrix2Xd& places) {
  const Index count_v = count_of(grid.knots_v, grid.degree_v);
  Triplets entries;
  entries.reserve(
      static_cast<std::size_t>(places.cols() * (grid.degree_u + 1) * (grid.degree_v + 1)));
  for (Index row = 0; row < places.cols(); ++row) {
    const Basis u = basis(grid.knots_u, grid.degree_u, places(0, row));
    const Basis v = basis(grid.knots_v, grid.degree_v, places(1, row));
    for (Index i = 0; i <= grid.degree_u; ++i)
      for (Index j = 0; j <= grid.degree_v; ++j)
        entries.emplace_back(static_cast<int>(row),
                             static_cast<int>((u.first + i) * count_v + v.first + j),
                             u.values(0, i) * v.values(0, j));
  }
  Sparse matrix(places.cols(), count_of(grid.knots_u, grid.degree_u) * count_v);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Sparse roughness(const Surface& grid, double width, double height, int order) {
  order = std::min({order, grid.degree_u, grid.degree_v});
  const Index count = count_of(grid.knots_u, grid.degree_u) * count_of(grid.knots_v, grid.degree_v);
  Triplets entries;
  double binomial = 1.0;
  for (int a = 0; a <= order; ++a) {
    const int b = order - a;
    const double factor =
        binomial * width * height / (std::pow(width, 2 * a) * std::pow(height, 2 * b));
    add_product(gram(grid.knots_u, grid.degree_u, a), gram(grid.knots_v, grid.degree_v, b), factor,
                grid.degree_u, grid.degree_v, entries);
    binomial = binomial * (order - a) / (a + 1);
  }
  Sparse matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Smoothed smooth_fit(const Sparse& design, const MatrixXd& targets, const VectorXd& weights,
                    const Sparse& penalty, const MatrixXd& load, double smoothness,
                    std::optional<double> lambda) {
  Problem problem(design, targets, weights, penalty, load);
  Smoothed best;
  if (lambda && problem.solve(*lambda, best)) return best;
  double least = std::numeric_limits<double>::infinity();
  double exponent = 0.0;
  const auto attempt = [&](double e) {
    Smoothed fit;
    if (!problem.solve(problem.scale() * std::pow(10.0, e), fit)) return;
    const double score = problem.score(fit);
    if (!(score < least)) return;
    least = score;
    exponent = e;
    best = std::move(fit);
  };
  for (double e = -9.0; e <= 2.5; e += 1.0) attempt(e);
  const double middle = exponent;
  for (const double e : {-0.67, -0.33, 0.33, 0.67}) attempt(middle + e);
  if (!std::isfinite(least))
    throw Error(Fault::stage, "the points do not determine a smooth surface")
        .hint("at least some twenty points that do not lie on a line are needed");
  if (smoothness != 1.0) {
    Smoothed fit;
    if (problem.solve(best.lambda * smoothness, fit)) best = std::move(fit);
  }
  return best;
}

}  // namespace velum::bspline
