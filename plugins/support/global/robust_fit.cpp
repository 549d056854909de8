// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "global/robust_fit.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/rigid_fit.hpp"

namespace velum::registration {
namespace {

constexpr int kSteps = 60;
constexpr double kGrowth = 1.4;  ///< of the control parameter, as its authors choose it
/// Spread along the second axis, of the bound's square, below which the turn is free.
constexpr double kLine = 4.0;

}  // namespace

RobustFit robust_fit(const std::vector<Match>& matches, std::span<const std::int32_t> chosen,
                     double bound) {
  const auto n = static_cast<Index>(chosen.size());
  RobustFit result;
  if (n < 3) return result;
  Eigen::Matrix3Xd from(3, n);
  Eigen::Matrix3Xd to(3, n);
  for (Index i = 0; i < n; ++i) {
    const Match& match = matches[static_cast<std::size_t>(chosen[static_cast<std::size_t>(i)])];
    from.col(i) = match.from;
    to.col(i) = match.to;
  }
  std::vector<double> weights(static_cast<std::size_t>(n), 1.0);
  geometry::RigidFit fit = geometry::rigid_fit(from, to, weights);
  const double bound2 = bound * bound;
  const auto squares = [&] {
    return Eigen::VectorXd(
        ((fit.pose * from.colwise().homogeneous()) - to).colwise().squaredNorm().transpose());
  };
  Eigen::VectorXd errors = squares();
  double mu = bound2 / std::max(2.0 * errors.maxCoeff() - bound2, 1e-30);
  for (int step = 0; step < kSteps && mu > 0.0; ++step) {
    double total = 0.0;
    bool binary = true;
    for (Index i = 0; i < n; ++i) {
      // Weights of the surrogate loss in closed form: 1 below its convex part, 0 above.
      const double low = mu / (mu + 1.0) * bound2;
      const double high = (mu + 1.0) / mu * bound2;
      double& w = weights[static_cast<std::size_t>(i)];
      w = errors[i] <= low    ? 1.0
          : errors[i] >= high ? 0.0
                              : std::sqrt(bound2 * mu * (mu + 1.0) / errors[i]) - mu;
      total += w;
      binary = binary && (w == 0.0 || w == 1.0);
    }
    if (total < 1e-9) return result;
    fit = geometry::rigid_fit(from, to, weights);
    errors = squares();
    if (binary && step > 0) break;
    mu *= kGrowth;
  }
  for (Index i = 0; i < n; ++i)
    if (errors[i] <= bound2) result.inliers.push_back(chosen[static_cast<std::size_t>(i)]);
  result.pose = fit.pose;
  result.fixed = result.inliers.size() >= 3 && fit.spread[1] > kLine * bound2;
  return result;
}

}  // namespace velum::registration
