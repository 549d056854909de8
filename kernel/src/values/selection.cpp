// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "values/selection.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace velum::spatial {
namespace {

/// Fewer than these are sorted by comparison at once.
constexpr std::size_t kFew = 24;
/// With more in one bucket, insertion would be slower than a sort of all.
constexpr std::uint32_t kCrowded = 24;
constexpr std::size_t kMostBuckets = 4096;

void insertion_sort(std::span<Neighbour> values) {
  for (std::size_t i = 1; i < values.size(); ++i) {
    const Neighbour value = values[i];
    std::size_t place = i;
    for (; place > 0 && before(value, values[place - 1]); --place)
      values[place] = values[place - 1];
    values[place] = value;
  }
}

}  // namespace

void Candidates::grow(std::size_t least) {
  capacity_ = std::max(least, 2 * capacity_);
  auto memory = std::make_unique_for_overwrite<Neighbour[]>(capacity_);
  std::copy_n(memory_.get(), count_, memory.get());
  memory_ = std::move(memory);
}

bool Selector::by_buckets(std::span<const Neighbour> candidates, std::size_t k, float limit2) {
  const std::size_t buckets = std::min(std::bit_ceil(candidates.size()), kMostBuckets);
  const float scale = static_cast<float>(buckets) / limit2;
  if (!std::isfinite(scale) || std::isinf(limit2)) return false;
  counts_.assign(buckets, 0);
  if (buckets_.size() < candidates.size()) buckets_.resize(candidates.size());
  if (sorted_.size() < candidates.size()) sorted_.resize(candidates.size());
  const auto last = static_cast<std::int32_t>(buckets - 1);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto bucket = static_cast<std::int32_t>(candidates[i].distance2 * scale);
    buckets_[i] = static_cast<std::uint32_t>(std::min(bucket, last));
    ++counts_[buckets_[i]];
  }
  // counts_ becomes the place of each bucket's next candidate. Buckets behind that of the k-th are
  // filled too, since that is cheaper than to ask, but not sorted.
  std::uint32_t sum = 0;
  std::uint32_t most = 0;
  std::uint32_t used = 0;
  for (std::uint32_t& count : counts_) {
    most = std::max(most, count);
    used = sum < k ? sum + count : used;
    sum += std::exchange(count, sum);
  }
  if (most > kCrowded) return false;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    sorted_[counts_[buckets_[i]]++] = candidates[i];
  insertion_sort(std::span(sorted_).first(used));
  return true;
}

std::span<const Neighbour> Selector::first(std::span<Neighbour> candidates, std::size_t k,
                                           float limit2) {
  k = std::min(k, candidates.size());
  // Over a surface squared distances are spread evenly, so that buckets hold one or two each.
  if (candidates.size() > kFew && by_buckets(candidates, k, limit2))
    return std::span(sorted_).first(k);
  const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(k);
  if (k < candidates.size()) std::nth_element(candidates.begin(), end, candidates.end(), before);
  std::sort(candidates.begin(), end, before);
  return candidates.first(k);
}

}  // namespace velum::spatial
