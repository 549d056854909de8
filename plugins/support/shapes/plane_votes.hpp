// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "geometry/plane_fit.hpp"
#include "shapes/consensus.hpp"

namespace velum::shapes {

/// The votes for planes: flat patches of the cloud, and the density of their planes.
class PlaneVotes {
 public:
  PlaneVotes(const Field& field, const Search& search, Context& context);

  /// The plane with the most votes, fitted to those that voted for it; nothing without votes.
  [[nodiscard]] std::optional<Shape> peak(Context& context) const;
  /// Takes back the votes of points whose label is not -1.
  void withdraw(const Eigen::VectorXi& labels);
  /// Takes back those for this plane, which gave no shape.
  void refuse(const Shape& plane);

 private:
  struct Patch {
    std::vector<std::int32_t> points;
    geometry::PointMoments moments;
    geometry::PlaneFit fit;
    double angle = 0.0;  ///< uncertainty of its normal [rad]
    double votes = 0.0;  ///< points not yet taken
  };
  void split(std::vector<std::int32_t>& points, std::size_t begin, std::size_t end,
             const Eigen::AlignedBox3d& box, Context& context);
  [[nodiscard]] double agreement(const Patch& a, const Patch& b) const;

  const Field& field_;
  double epsilon_;
  double angle_;
  std::vector<Patch> patches_;
};

}  // namespace velum::shapes
