// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "global/matches.hpp"

namespace velum::registration {

/// Which matches one rigid motion could bring about together: an edge joins two matches whose
/// points lie equally far apart and whose normals make the same angles with each other and with the
/// line between them, in both clouds (Yang, Shi, Carlone 2020; the normals are our addition and
/// leave about a tenth of the edges).
class ConsistencyGraph {
 public:
  struct Limits {
    double length = 0.0;    ///< that two lengths may differ by [m]
    double shortest = 0.0;  ///< pairs of points nearer than this tell nothing [m]
    double cosine = 0.25;   ///< that the cosines may differ by
  };
  ConsistencyGraph(const std::vector<Match>& matches, const Limits& limits, Context& context);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] int degree(std::size_t match) const { return degree_[match]; }
  [[nodiscard]] bool joined(std::size_t a, std::size_t b) const {
    return ((row(a)[b / 64] >> (b % 64)) & 1U) != 0;
  }
  /// The largest k for which each match lies in a subgraph where all have k edges: a match of a
  /// clique of n has at least n - 1 (Shi, Yang, Carlone 2021).
  [[nodiscard]] std::vector<int> core_numbers() const;
  /// A clique that `seed` belongs to, grown by the match that leaves most to choose from.
  [[nodiscard]] std::vector<std::int32_t> clique_of(std::size_t seed) const;

 private:
  [[nodiscard]] const std::uint64_t* row(std::size_t match) const {
    return bits_.data() + match * words_;
  }
  std::size_t size_ = 0;
  std::size_t words_ = 0;
  std::vector<std::uint64_t> bits_;
  std::vector<int> degree_;
};

}  // namespace velum::registration
