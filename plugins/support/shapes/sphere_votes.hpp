// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "shapes/consensus.hpp"
#include "shapes/hough.hpp"

namespace velum::shapes {

/// The votes for spheres: near triples of points, each with the sphere that its normals tell.
class SphereVotes {
 public:
  SphereVotes(const Field& field, const Search& search, const Votes& votes, Context& context);

  /// The sphere whose cell and its neighbours hold the most votes, fitted to the points that cast
  /// them; nothing without votes.
  [[nodiscard]] std::optional<Shape> peak(Context& context) const;
  /// Takes back the votes of points whose label is not -1.
  void withdraw(const Eigen::VectorXi& labels);
  /// Takes back those for this sphere, which gave no shape.
  void refuse(const Shape& sphere);

 private:
  using Bin = std::array<std::int64_t, 4>;  // centre and radius
  struct Vote {
    Bin bin;
    Shape sphere;
    std::array<std::int32_t, 3> points;
  };
  [[nodiscard]] Bin bin_of(const Shape& sphere) const;

  const Field& field_;
  double bin_;
  std::vector<Vote> votes_;  ///< by bin
};

}  // namespace velum::shapes
