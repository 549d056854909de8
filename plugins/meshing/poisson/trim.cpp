// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "trim.hpp"

#include <algorithm>
#include <map>

namespace velum::meshing {
namespace {

constexpr Index kDisc = 12;

/// Squared radius of the disc of twelve points around each point of the cloud, itself not counted.
Eigen::VectorXf own_discs(const Cloud& cloud, Context& context) {
  Eigen::VectorXf discs(cloud.size());
  cloud.neighbours().each_nearest(
      kDisc + 1, context, [&](Index query, auto found) { discs[query] = found.back().distance2; });
  return discs;
}

class Cutter {
 public:
  Cutter(const Draft& draft, const Eigen::VectorXd& margins) : margins_(margins) {
    for (Index v = 0; v < draft.positions.cols(); ++v) vertices_.push_back(draft.positions.col(v));
  }

  void add(const mesh::Triangle& t) {
    std::vector<std::int32_t> polygon;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = t[i];
      const std::int32_t b = t[(i + 1) % 3];
      if (margins_[a] >= 0.0) polygon.push_back(a);
      if ((margins_[a] >= 0.0) != (margins_[b] >= 0.0)) polygon.push_back(crossing(a, b));
    }
    for (std::size_t i = 2; i < polygon.size(); ++i) emit({polygon[0], polygon[i - 1], polygon[i]});
  }

  Draft take() {
    Draft draft;
    draft.positions.resize(3, static_cast<Index>(vertices_.size()));
    for (std::size_t v = 0; v < vertices_.size(); ++v)
      draft.positions.col(static_cast<Index>(v)) = vertices_[v];
    draft.triangles = std::move(triangles_);
    return draft;
  }

 private:
  /// The vertex where the edge leaves the support; one for both of its triangles. A crossing at an
  /// end of the edge is that end.
  std::int32_t crossing(std::int32_t a, std::int32_t b) {
    const auto [low, high] = std::minmax(a, b);
    const double share = margins_[low] / (margins_[low] - margins_[high]);
    constexpr double kNear = 0.05;  // of the edge; closer cuts leave slivers
    if (share < kNear && margins_[low] >= 0.0) return low;
    if (share > 1.0 - kNear && margins_[high] >= 0.0) return high;
    const auto [place, is_new] =
        crossings_.try_emplace({low, high}, static_cast<std::int32_t>(vertices_.size()));
    if (is_new) {
      const Eigen::Vector3f from = vertices_[static_cast<std::size_t>(low)];
      const Eigen::Vector3f to = vertices_[static_cast<std::size_t>(high)];
      vertices_.emplace_back(from + static_cast<float>(share) * (to - from));
    }
    return place->second;
  }

  void emit(const mesh::Triangle& t) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles_.push_back(t);
  }

  const Eigen::VectorXd& margins_;
  std::vector<Eigen::Vector3f> vertices_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> crossings_;
  std::vector<mesh::Triangle> triangles_;
};

}  // namespace

Eigen::VectorXd margins(const Points& vertices, const Cloud& cloud, const Support& support,
                        Context& context) {
  const Eigen::VectorXf discs = own_discs(cloud, context);
  Eigen::VectorXd found(vertices.cols());
  const ConstPoints queries(vertices.data(), 3, vertices.cols());
  cloud.neighbours().each_nearest(queries, kDisc, context, [&](Index query, auto near) {
    double margin = 1.0;
    if (support.max_distance > 0.0)
      margin = std::min(margin, 1.0 - std::sqrt(near.front().distance2) / support.max_distance);
    const double disc = near.back().distance2;
    if (support.min_density > 0.0 && disc > 0.0) {
      double usual = 0.0;
      for (const Neighbour& point : near) usual += discs[point.index];
      usual /= static_cast<double>(near.size());
      margin = std::min(margin, usual / disc / support.min_density - 1.0);
    }
    found[query] = margin;
  });
  return found;
}

void cut(Draft& draft, const Eigen::VectorXd& margins) {
  Cutter cutter(draft, margins);
  for (const mesh::Triangle& t : draft.triangles) cutter.add(t);
  draft = cutter.take();
}

}  // namespace velum::meshing
