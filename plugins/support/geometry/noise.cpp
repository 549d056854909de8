// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/eigen3.hpp"
#include "geometry/moments.hpp"
#include "geometry/normals.hpp"

namespace velum::geometry {
namespace {

using Found = std::span<const Neighbour>;

constexpr std::array<std::size_t, 5> kSizes = {12, 24, 48, 96, 192};
constexpr Index kSamples = 512;
constexpr int kTerms = 6;

// Root mean square residual [m] of z = a + bx + cy + dx² + exy + fy² over the neighbours, in the
// frame of their principal axes; freedoms taken by the fit are accounted for.
double quadric_residual(const ConstPoints& positions, Index query, Found found) {
  const Eigen::Vector3f centre = positions.col(query);
  NeighbourMoments moments;
  for (const Neighbour& n : found) moments.add(positions.col(n.index) - centre);
  const Eigen3 axes = eigen3(moments.covariance());
  const double scale = std::sqrt(axes.values[2]);
  if (!(scale > 0.0)) return 0.0;
  using Square = Eigen::Matrix<double, kTerms, kTerms>;
  using Vector = Eigen::Matrix<double, kTerms, 1>;
  Square normal = Square::Zero();
  Vector right = Vector::Zero();
  double heights = 0.0;
  for (const Neighbour& n : found) {
    const Eigen::Vector3d d =
        axes.vectors.transpose() * (positions.col(n.index) - centre).cast<double>() / scale;
    const Vector row{1.0, d.y(), d.z(), d.y() * d.y(), d.y() * d.z(), d.z() * d.z()};
    normal.noalias() += row * row.transpose();
    right += d.x() * row;
    heights += d.x() * d.x();
  }
  const double squares = heights - right.dot(normal.ldlt().solve(right));
  const double freedoms = static_cast<double>(found.size()) - kTerms;
  return scale * std::sqrt(std::max(squares, 0.0) / freedoms);
}

// The residual over the smallest neighbourhood whose radius is at least three times as large: in a
// smaller one the ball cuts the noise off. The largest one's where none is.
double noise_at(const ConstPoints& positions, Index query, Found found) {
  double residual = 0.0;
  for (const std::size_t size : kSizes) {
    if (size > found.size()) break;
    residual = quadric_residual(positions, query, found.first(size));
    if (std::sqrt(static_cast<double>(found[size - 1].distance2)) >= 3.0 * residual) break;
  }
  return residual;
}

}  // namespace

double estimate_noise(const Cloud& cloud, Context& context) {
  const ConstPoints positions = cloud.positions();
  if (cloud.size() < static_cast<Index>(kSizes.front())) return 0.0;
  const Index samples = std::min(cloud.size(), kSamples);
  std::vector<Index> chosen(static_cast<std::size_t>(samples));
  Points queries(3, samples);
  for (Index i = 0; i < samples; ++i) {
    chosen[static_cast<std::size_t>(i)] = i * cloud.size() / samples;
    queries.col(i) = positions.col(i * cloud.size() / samples);
  }
  std::vector<double> residuals(chosen.size());
  const ConstPoints view(queries.data(), 3, samples);
  cloud.neighbours().each_nearest(view, static_cast<Index>(kSizes.back()), context,
                                  [&](Index i, Found found) {
                                    const auto slot = static_cast<std::size_t>(i);
                                    residuals[slot] = noise_at(positions, chosen[slot], found);
                                  });
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return *middle;
}

}  // namespace velum::geometry
