// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "velum/neighbours.hpp"

namespace velum::spatial {

/// Order of answers: by distance, then by index. Squared distances are not negative, so that their
/// bits ascend as they do.
inline std::uint64_t rank(const Neighbour& neighbour) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(neighbour.distance2)} << 32U |
         static_cast<std::uint32_t>(neighbour.index);
}
inline bool before(const Neighbour& a, const Neighbour& b) {
  return rank(a) < rank(b);
}

/// Brings the `k` first of many candidates into order. One per thread: it keeps its memory.
class Selector {
 public:
  /// Leaves the `k` first of `candidates` (all when there are fewer), in order. No distance is
  /// larger than `limit2`.
  void first(std::vector<Neighbour>& candidates, std::size_t k, float limit2);

 private:
  bool by_buckets(std::vector<Neighbour>& candidates, std::size_t k, float limit2);
  std::vector<std::uint32_t> counts_;
  std::vector<std::uint32_t> buckets_;
  std::vector<Neighbour> sorted_;
};

}  // namespace velum::spatial
