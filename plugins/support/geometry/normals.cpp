// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "geometry/normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "geometry/eigen3.hpp"
#include "geometry/moments.hpp"
#include "geometry/viewpoint.hpp"

namespace velum::geometry {
namespace {

using Found = std::span<const Neighbour>;

// Sizes at which an automatic neighbourhood is judged, and those at which the search is widened for
// the points that need more.
constexpr std::array<Index, 10> kSteps = {10, 15, 22, 32, 48, 72, 108, 160, 240, 360};
constexpr std::array<Index, 4> kLevels = {32, 72, 160, 360};
// A neighbourhood is a line when its second extent is below this share of its first (squared).
constexpr double kLine = 1e-10;

// What a neighbourhood says of the surface.
struct Fit {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d values = Eigen::Vector3d::Zero();
  Index count = 0;

  [[nodiscard]] bool fixes_a_plane() const {
    return count >= 3 && values[2] > 0.0 && values[1] > kLine * values[2];
  }
};

Fit fit_of(const NeighbourMoments& moments) {
  Fit fit{moments.covariance(), {}, moments.count()};
  fit.values = eigenvalues3(fit.covariance);
  // Close to a line the closed form is too coarse to tell a thin neighbourhood from a line.
  if (fit.values[1] < 1e-6 * fit.values[2]) fit.values = eigen3(fit.covariance).values;
  fit.values = fit.values.cwiseMax(0.0);
  return fit;
}

// Grows a neighbourhood for one point by the rules of NormalOptions.
class Growth {
 public:
  Growth(double noise, double accuracy)
      : variance_(noise * noise), accuracy2_(accuracy * accuracy) {}

  // Is it settled with these neighbours? `fit` is then, and else for the time being, the best.
  bool settle(const ConstPoints& positions, Index query, Found found, Fit& fit) const {
    const Eigen::Vector3f centre = positions.col(query);
    NeighbourMoments moments;
    auto step = kSteps.begin();
    for (std::size_t i = 0; i < found.size(); ++i) {
      moments.add(positions.col(found[i].index) - centre);
      const bool last = i + 1 == found.size();
      if (!last && moments.count() < *step) continue;
      const Fit next = fit_of(moments);
      if (fit.fixes_a_plane() && bends(next)) return true;
      fit = next;
      if (good_enough(fit)) return true;
      ++step;
    }
    return false;
  }

 private:
  // Residual beyond what noise explains, two standard deviations of the estimate and a margin for
  // the noise's own spread over the cloud included.
  [[nodiscard]] bool bends(const Fit& fit) const {
    const double freedoms = static_cast<double>(std::max<Index>(fit.count - 3, 1));
    const double residual2 = fit.values[0] * static_cast<double>(fit.count) / freedoms;
    return residual2 > 2.25 * variance_ * (1.0 + 2.0 * std::sqrt(2.0 / freedoms));
  }
  // Variance of a fitted plane's slope along an axis: σ²/(k·λ). On a disc λ = r²/4, which gives
  // √2·2σ/(r√k) for both axes together.
  [[nodiscard]] bool good_enough(const Fit& fit) const {
    if (fit.count < kSteps.front() || fit.values[1] <= 1e-3 * fit.values[2]) return false;
    const double k = static_cast<double>(fit.count);
    return variance_ * (1.0 / fit.values[1] + 1.0 / fit.values[2]) <= accuracy2_ * k;
  }

  double variance_;
  double accuracy2_;
};

// Everything that the estimate of one cloud shares.
class Estimator {
 public:
  Estimator(const Cloud& cloud, Context& context)
      : cloud_(cloud), positions_(cloud.positions()), viewpoints_(cloud), context_(context) {
    field_.normals.resize(3, cloud.size());
    field_.curvature.resize(cloud.size());
    counts_.assign(static_cast<std::size_t>(cloud.size()), 0);
    degenerate_.assign(counts_.size(), 0);
  }

  void fixed(const NormalOptions& options) {
    const float limit = options.radius ? static_cast<float>(*options.radius * *options.radius)
                                       : std::numeric_limits<float>::infinity();
    const auto visit = [&](Index query, Found found) {
      const Eigen::Vector3f centre = positions_.col(query);
      NeighbourMoments moments;
      for (const Neighbour& n : found) {
        if (n.distance2 > limit) break;
        moments.add(positions_.col(n.index) - centre);
      }
      finish(query, fit_of(moments));
    };
    if (options.neighbours)
      cloud_.neighbours().each_nearest(*options.neighbours, context_, visit);
    else
      cloud_.neighbours().each_within(*options.radius, context_, visit);
  }

  void automatic(const NormalOptions& options) {
    field_.noise = options.noise ? *options.noise : estimate_noise(cloud_, context_);
    const Growth growth(field_.noise, options.accuracy);
    std::vector<std::int32_t> pending(counts_.size());
    std::iota(pending.begin(), pending.end(), 0);
    for (std::size_t level = first_level(growth); !pending.empty(); ++level) {
      const bool last = level + 1 == kLevels.size() || kLevels[level] >= cloud_.size();
      pending = grow(growth, pending, kLevels[level], last);
      context_.progress(1.0 -
                        static_cast<double>(pending.size()) / static_cast<double>(counts_.size()));
    }
  }

  NormalField take() {
    field_.degenerate = std::accumulate(degenerate_.begin(), degenerate_.end(), Index{0});
    const double sum = std::accumulate(counts_.begin(), counts_.end(), 0.0);
    field_.neighbours = counts_.empty() ? 0.0 : sum / static_cast<double>(counts_.size());
    return std::move(field_);
  }

 private:
  // The search width to begin with: the least that settles half of a sample of the points.
  [[nodiscard]] std::size_t first_level(const Growth& growth) const {
    const Index samples = std::min<Index>(cloud_.size(), 256);
    const auto chosen = [&](Index slot) { return slot * cloud_.size() / samples; };
    Points queries(3, samples);
    for (Index i = 0; i < samples; ++i) queries.col(i) = positions_.col(chosen(i));
    std::vector<Index> needed(static_cast<std::size_t>(samples));
    const ConstPoints view(queries.data(), 3, samples);
    cloud_.neighbours().each_nearest(view, kLevels.back(), context_, [&](Index slot, Found found) {
      Fit fit;
      growth.settle(positions_, chosen(slot), found, fit);
      needed[static_cast<std::size_t>(slot)] = fit.count;
    });
    const auto middle = needed.begin() + samples / 2;
    std::nth_element(needed.begin(), middle, needed.end());
    const auto* level = std::find_if(kLevels.begin(), kLevels.end() - 1,
                                     [&](Index size) { return size >= *middle; });
    return static_cast<std::size_t>(level - kLevels.begin());
  }

  // Settles what `size` neighbours settle (all of it at the last level) and returns the others.
  std::vector<std::int32_t> grow(const Growth& growth, const std::vector<std::int32_t>& pending,
                                 Index size, bool last) {
    std::vector<std::uint8_t> unsettled(pending.size(), 0);
    const auto settle = [&](std::size_t slot, Index query, Found found) {
      Fit fit;
      if (growth.settle(positions_, query, found, fit) || last)
        finish(query, fit);
      else
        unsettled[slot] = 1;
    };
    const Neighbours& neighbours = cloud_.neighbours();
    if (pending.size() == counts_.size()) {
      neighbours.each_nearest(size, context_, [&](Index query, Found found) {
        settle(static_cast<std::size_t>(query), query, found);
      });
    } else {
      Points queries(3, static_cast<Index>(pending.size()));
      for (std::size_t i = 0; i < pending.size(); ++i)
        queries.col(static_cast<Index>(i)) = positions_.col(pending[i]);
      const ConstPoints view(queries.data(), 3, queries.cols());
      neighbours.each_nearest(view, size, context_, [&](Index slot, Found found) {
        const auto at = static_cast<std::size_t>(slot);
        settle(at, pending[at], found);
      });
    }
    std::vector<std::int32_t> rest;
    for (std::size_t i = 0; i < pending.size(); ++i)
      if (unsettled[i] != 0) rest.push_back(pending[i]);
    return rest;
  }

  void finish(Index query, const Fit& fit) {
    const Eigen::Vector3d view = viewpoints_.from(query);
    Eigen::Vector3d normal;
    if (fit.fixes_a_plane()) {
      normal = smallest_eigenvector3(fit.covariance, fit.values);
      field_.curvature[query] = static_cast<float>(fit.values[0] / fit.values.sum());
    } else {
      normal = without_plane(fit, view);
      field_.curvature[query] = 0.0F;
      degenerate_[static_cast<std::size_t>(query)] = 1;
    }
    if (normal.dot(view) < 0.0) normal = -normal;
    field_.normals.col(query) = normal.cast<float>();
    counts_[static_cast<std::size_t>(query)] = static_cast<std::int32_t>(fit.count);
  }

  // Towards the sensor, square to the neighbours' line where there is one.
  static Eigen::Vector3d without_plane(const Fit& fit, const Eigen::Vector3d& view) {
    const bool line = fit.values[2] > 0.0;
    Eigen::Vector3d normal = view;
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    if (line) {
      axes = eigen3(fit.covariance).vectors;
      normal -= view.dot(axes.col(2)) * axes.col(2);
    }
    const double length = normal.norm();
    if (length > 1e-9 * view.norm() && length > 0.0) return normal / length;
    return line ? Eigen::Vector3d(axes.col(0)) : Eigen::Vector3d::UnitZ();
  }

  const Cloud& cloud_;
  ConstPoints positions_;
  Viewpoints viewpoints_;
  Context& context_;
  NormalField field_;
  std::vector<std::int32_t> counts_;
  std::vector<std::uint8_t> degenerate_;
};

}  // namespace

NormalField estimate_normals(const Cloud& cloud, const NormalOptions& options, Context& context) {
  context.check();
  Estimator estimator(cloud, context);
  if (cloud.empty()) return estimator.take();
  if (options.neighbours || options.radius)
    estimator.fixed(options);
  else
    estimator.automatic(options);
  return estimator.take();
}

}  // namespace velum::geometry
