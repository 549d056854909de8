// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "features/histograms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace velum::features {
namespace {

constexpr Index kFastSplit = 11;
constexpr Index kFullSplit = 5;
constexpr float kWhole = 100.0F;

/// θ/2π, α/2 and φ/2, each shifted to [0, 1].
struct Angles {
  float theta;
  float alpha;
  float phi;
};

/// Equation 3.4. Of the two points the one whose normal makes the smaller angle with the line
/// between them carries the frame, so that the order of the pair does not matter. False for points
/// in one place and for a normal along the line, which leaves the frame free.
bool angles_between(const Eigen::Vector3f& p, const Eigen::Vector3f& np, const Eigen::Vector3f& q,
                    const Eigen::Vector3f& nq, Angles& out) {
  Eigen::Vector3f line = q - p;
  const float length = line.norm();
  if (!(length > 0.0F)) return false;
  line /= length;
  const float first = np.dot(line);
  const float second = nq.dot(line);
  const bool swap = std::abs(first) < std::abs(second);
  if (swap) line = -line;
  const Eigen::Vector3f& u = swap ? nq : np;
  const Eigen::Vector3f& n = swap ? np : nq;
  Eigen::Vector3f v = line.cross(u);
  const float sine = v.norm();
  if (!(sine > 0.0F)) return false;
  v /= sine;
  const Eigen::Vector3f w = u.cross(v);
  constexpr float kTurn = 0.5F * std::numbers::inv_pi_v<float>;
  out.theta = std::atan2(w.dot(n), u.dot(n)) * kTurn + 0.5F;
  out.alpha = 0.5F * (v.dot(n) + 1.0F);
  out.phi = 0.5F * ((swap ? -second : first) + 1.0F);
  return true;
}

Index bin(float share, Index bins) {
  return std::clamp<Index>(static_cast<Index>(std::floor(share * static_cast<float>(bins))), 0,
                           bins - 1);
}

bool is_unit(const Eigen::Vector3f& normal) {
  return std::abs(normal.squaredNorm() - 1.0F) < 1e-2F;
}

void each_neighbourhood(const Cloud& cloud, const Neighbourhood& neighbourhood, Context& context,
                        const Neighbours::Visitor& visit) {
  if (cloud.empty()) return;
  const Neighbours& index = cloud.neighbours();
  if (!neighbourhood.neighbours) return index.each_within(*neighbourhood.radius, context, visit);
  const Index k = std::min(*neighbourhood.neighbours, cloud.size());
  if (!neighbourhood.radius) return index.each_nearest(k, context, visit);
  const auto most = static_cast<float>(*neighbourhood.radius * *neighbourhood.radius);
  index.each_nearest(k, context, [&](Index query, std::span<const Neighbour> found) {
    std::size_t count = found.size();
    while (count > 0 && found[count - 1].distance2 > most) --count;
    visit(query, found.first(count));
  });
}

/// Simplified histograms: one point with each of its neighbours.
Eigen::MatrixXf simplified(const Cloud& cloud, const Neighbourhood& neighbourhood,
                           Context& context) {
  const auto points = cloud.positions();
  const auto normals = cloud.normals();
  Eigen::MatrixXf histograms = Eigen::MatrixXf::Zero(kFpfhBins, cloud.size());
  each_neighbourhood(
      cloud, neighbourhood, context, [&](Index query, std::span<const Neighbour> found) {
        if (found.size() < 2 || !is_unit(normals.col(query))) return;
        const float one = kWhole / static_cast<float>(found.size() - 1);
        auto histogram = histograms.col(query);
        Angles angles{};
        for (const Neighbour& other : found) {
          if (other.index == query || !is_unit(normals.col(other.index)) ||
              !angles_between(points.col(query), normals.col(query), points.col(other.index),
                              normals.col(other.index), angles))
            continue;
          histogram[bin(angles.theta, kFastSplit)] += one;
          histogram[kFastSplit + bin(angles.alpha, kFastSplit)] += one;
          histogram[2 * kFastSplit + bin(angles.phi, kFastSplit)] += one;
        }
      });
  return histograms;
}

}  // namespace

Eigen::MatrixXf fpfh(const Cloud& cloud, const Neighbourhood& neighbourhood, Context& context) {
  const Eigen::MatrixXf simple = simplified(cloud, neighbourhood, context);
  Eigen::MatrixXf histograms = Eigen::MatrixXf::Zero(kFpfhBins, cloud.size());
  each_neighbourhood(cloud, neighbourhood, context,
                     [&](Index query, std::span<const Neighbour> found) {
                       Eigen::Matrix<float, kFpfhBins, 1> sum;
                       sum.setZero();
                       for (const Neighbour& other : found)
                         if (other.distance2 > 0.0F)
                           sum += simple.col(other.index) * (1.0F / other.distance2);
                       for (Index part = 0; part < 3; ++part) {
                         auto bins = sum.segment<kFastSplit>(part * kFastSplit);
                         const float total = bins.sum();
                         if (total > 0.0F && std::isfinite(total))
                           bins *= kWhole / total;
                         else
                           bins.setZero();
                       }
                       histograms.col(query) = sum;
                     });
  return histograms;
}

Eigen::MatrixXf pfh(const Cloud& cloud, const Neighbourhood& neighbourhood, Context& context) {
  const auto points = cloud.positions();
  const auto normals = cloud.normals();
  Eigen::MatrixXf histograms = Eigen::MatrixXf::Zero(kPfhBins, cloud.size());
  each_neighbourhood(
      cloud, neighbourhood, context, [&](Index query, std::span<const Neighbour> found) {
        const auto n = static_cast<Index>(found.size());
        if (n < 2) return;
        const float one = kWhole / (0.5F * static_cast<float>(n) * static_cast<float>(n - 1));
        auto histogram = histograms.col(query);
        Angles angles{};
        for (std::size_t i = 0; i < found.size(); ++i) {
          context.check();
          const std::int32_t a = found[i].index;
          if (!is_unit(normals.col(a))) continue;
          for (std::size_t j = 0; j < i; ++j) {
            const std::int32_t b = found[j].index;
            if (!is_unit(normals.col(b)) || !angles_between(points.col(a), normals.col(a),
                                                            points.col(b), normals.col(b), angles))
              continue;
            histogram[bin(angles.theta, kFullSplit) +
                      kFullSplit * (bin(angles.alpha, kFullSplit) +
                                    kFullSplit * bin(angles.phi, kFullSplit))] += one;
          }
        }
      });
  return histograms;
}

Eigen::MatrixXf mirrored_fpfh(const Eigen::MatrixXf& histograms) {
  Eigen::MatrixXf mirrored = histograms;
  for (const Index part : {Index{0}, 2 * kFastSplit})
    mirrored.middleRows(part, kFastSplit) =
        histograms.middleRows(part, kFastSplit).colwise().reverse();
  return mirrored;
}

Eigen::MatrixXf mirrored_pfh(const Eigen::MatrixXf& histograms) {
  Eigen::MatrixXf mirrored(histograms.rows(), histograms.cols());
  for (Index phi = 0; phi < kFullSplit; ++phi)
    for (Index alpha = 0; alpha < kFullSplit; ++alpha)
      for (Index theta = 0; theta < kFullSplit; ++theta) {
        const auto at = [&](Index t, Index p) { return t + kFullSplit * (alpha + kFullSplit * p); };
        mirrored.row(at(kFullSplit - 1 - theta, kFullSplit - 1 - phi)) =
            histograms.row(at(theta, phi));
      }
  return mirrored;
}

}  // namespace velum::features
