// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "global/sampled.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "features/histograms.hpp"
#include "geometry/normals.hpp"
#include "geometry/thinning.hpp"

namespace velum::registration {
namespace {

constexpr Index kSignNeighbours = 10;
/// Each feature is compared with so many of all.
constexpr Index kReferences = 500;
/// Features of one kind of surface, sampled at random, differ by some 10 to 30; those of plane,
/// cylinder, cone and sphere by 90 and more.
constexpr float kAlike = 50.0F;
/// What this share of the cloud looks like is rare enough to count in full.
constexpr float kRare = 0.05F;
constexpr Index kBlock = 256;

/// How far each feature lies from the mean of all: what most points look like tells nothing.
std::vector<std::int32_t> least_common(const Eigen::MatrixXf& features, Index most) {
  const Eigen::VectorXf mean = features.rowwise().mean();
  const Eigen::VectorXf distance = (features.colwise() - mean).colwise().squaredNorm().transpose();
  std::vector<std::int32_t> order;
  for (Index i = 0; i < features.cols(); ++i)
    if (features.col(i).squaredNorm() > 0.0F) order.push_back(static_cast<std::int32_t>(i));
  if (static_cast<Index>(order.size()) > most) {
    std::stable_sort(order.begin(), order.end(),
                     [&](std::int32_t a, std::int32_t b) { return distance[a] > distance[b]; });
    order.resize(static_cast<std::size_t>(most));
    std::sort(order.begin(), order.end());
  }
  return order;
}

}  // namespace

std::vector<float> rarity(const Eigen::MatrixXf& fpfh, Context& context) {
  const Index stride = std::max<Index>(1, fpfh.cols() / kReferences);
  const Index count = fpfh.cols() == 0 ? 0 : (fpfh.cols() - 1) / stride + 1;
  Eigen::MatrixXf some(fpfh.rows(), count);
  for (Index i = 0; i < count; ++i) some.col(i) = fpfh.col(i * stride);
  const Eigen::MatrixXf mirrored = features::mirrored_fpfh(some);
  // |f - s|² = |f|² - 2 f·s + |s|², and a mirror image is as long as what it is of.
  const Eigen::VectorXf lengths = some.colwise().squaredNorm().transpose();
  std::vector<float> rare(static_cast<std::size_t>(fpfh.cols()), 0.0F);
  parallel_for(context, fpfh.cols(), kBlock, [&](Index begin, Index end) {
    const auto block = fpfh.middleCols(begin, end - begin);
    const Eigen::MatrixXf products =
        (some.transpose() * block).cwiseMax(mirrored.transpose() * block);
    for (Index i = begin; i < end; ++i) {
      const float length = fpfh.col(i).squaredNorm();
      if (!(length > 0.0F)) continue;
      const auto alike =
          ((lengths - 2.0F * products.col(i - begin)).array() + length < kAlike * kAlike).count();
      const float share = static_cast<float>(alike) / static_cast<float>(count);
      rare[static_cast<std::size_t>(i)] = kRare / std::max(kRare, share);
    }
  });
  return rare;
}

void agree_on_sign(const Cloud& cloud, Points& normals, Index neighbours, Context& context) {
  const Index n = cloud.size();
  const Index k = std::min(neighbours, n);
  Eigen::MatrixXi near = Eigen::MatrixXi::Constant(k, n, -1);
  cloud.neighbours().each_nearest(k, context, [&](Index query, std::span<const Neighbour> found) {
    for (std::size_t i = 0; i < found.size(); ++i)
      near(static_cast<Index>(i), query) = found[i].index;
  });
  // Prim's spanning tree over edges |n·m|, strongest first (Hoppe et al. 1992).
  std::vector<char> done(static_cast<std::size_t>(n), 0);
  using Edge = std::tuple<float, std::int32_t, std::int32_t>;
  std::priority_queue<Edge> edges;
  const auto settle = [&](std::int32_t point) {
    done[static_cast<std::size_t>(point)] = 1;
    for (Index i = 0; i < k; ++i) {
      const std::int32_t other = near(i, point);
      if (other >= 0 && done[static_cast<std::size_t>(other)] == 0)
        edges.emplace(std::abs(normals.col(point).dot(normals.col(other))), -other, -point);
    }
  };
  for (std::int32_t start = 0; start < n; ++start) {
    if (done[static_cast<std::size_t>(start)] != 0) continue;
    settle(start);
    while (!edges.empty()) {
      const auto [weight, to, from] = edges.top();
      edges.pop();
      if (done[static_cast<std::size_t>(-to)] != 0) continue;
      if (normals.col(-to).dot(normals.col(-from)) < 0.0F) normals.col(-to) *= -1.0F;
      settle(-to);
    }
  }
}

Sampled sample(const Cloud& cloud, const SampleOptions& options, Context& context) {
  Sampled sampled;
  geometry::Thinned thinned = geometry::thin(cloud.positions(), options.cell);
  sampled.cell = thinned.cell;
  Cloud thin(std::move(thinned.means), cloud.origin());
  context.check();
  geometry::NormalOptions normal_options;
  normal_options.radius = options.normal_cells * sampled.cell;
  Points normals = geometry::estimate_normals(thin, normal_options, context).normals;
  agree_on_sign(thin, normals, kSignNeighbours, context);
  sampled.cloud = thin.with(column::kNormals, Column(std::move(normals)));
  context.check();
  const features::Neighbourhood around{{}, options.feature_cells * sampled.cell};
  const Eigen::MatrixXf all = options.full ? features::pfh(sampled.cloud, around, context)
                                           : features::fpfh(sampled.cloud, around, context);
  if (!options.full) sampled.rarity = rarity(all, context);
  sampled.keys = least_common(all, options.keys);
  sampled.features.resize(all.rows(), static_cast<Index>(sampled.keys.size()));
  for (std::size_t i = 0; i < sampled.keys.size(); ++i)
    sampled.features.col(static_cast<Index>(i)) = all.col(sampled.keys[i]);
  return sampled;
}

}  // namespace velum::registration
