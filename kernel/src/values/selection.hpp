// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "velum/neighbours.hpp"

namespace velum::spatial {

/// Order of answers: by distance, then by index. Squared distances are not negative, so that their
/// bits ascend as they do; on this byte order they are the upper half of a neighbour.
inline std::uint64_t rank(const Neighbour& neighbour) {
  static_assert(std::endian::native == std::endian::little);
  return std::bit_cast<std::uint64_t>(neighbour);
}
inline bool before(const Neighbour& a, const Neighbour& b) {
  return rank(a) < rank(b);
}

/// Memory for neighbours that are found one leaf after the other. It only grows and is never filled
/// with zeros, which would cost more than the search.
class Candidates {
 public:
  /// Where the next `room` candidates may be written.
  Neighbour* end_with_room(std::size_t room) {
    if (count_ + room > capacity_) grow(count_ + room);
    return memory_.get() + count_;
  }
  void set_end(const Neighbour* end) { count_ = static_cast<std::size_t>(end - memory_.get()); }
  void clear() { count_ = 0; }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] std::span<Neighbour> all() { return {memory_.get(), count_}; }

 private:
  void grow(std::size_t least);
  std::unique_ptr<Neighbour[]> memory_;
  std::size_t count_ = 0;
  std::size_t capacity_ = 0;
};

/// Brings the `k` first of many candidates into order. One per thread: it keeps its memory.
class Selector {
 public:
  /// The `k` first of `candidates` (all when there are fewer), in order; valid until the next call.
  /// Reorders the candidates. No distance is larger than `limit2`.
  std::span<const Neighbour> first(std::span<Neighbour> candidates, std::size_t k, float limit2);

 private:
  bool by_buckets(std::span<const Neighbour> candidates, std::size_t k, float limit2);
  std::vector<std::uint32_t> counts_;
  std::vector<std::uint32_t> buckets_;
  std::vector<Neighbour> sorted_;
};

}  // namespace velum::spatial
