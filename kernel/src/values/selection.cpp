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

void insertion_sort(std::vector<Neighbour>& values) {
  for (std::size_t i = 1; i < values.size(); ++i) {
    const Neighbour value = values[i];
    std::size_t place = i;
    for (; place > 0 && before(value, values[place - 1]); --place)
      values[place] = values[place - 1];
    values[place] = value;
  }
}

}  // namespace

bool Selector::by_buckets(std::vector<Neighbour>& candidates, std::size_t k, float limit2) {
  const std::size_t buckets = std::min(std::bit_ceil(candidates.size()), kMostBuckets);
  const float scale = static_cast<float>(buckets) / limit2;
  if (!std::isfinite(scale) || std::isinf(limit2)) return false;
  counts_.assign(buckets, 0);
  buckets_.resize(candidates.size());
  const auto last = static_cast<std::uint32_t>(buckets - 1);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto bucket =
        static_cast<std::uint32_t>(static_cast<std::int32_t>(candidates[i].distance2 * scale));
    buckets_[i] = std::min(bucket, last);
    ++counts_[buckets_[i]];
  }
  // counts_ becomes the place of each bucket's next candidate; buckets behind the k-th are not
  // used.
  std::uint32_t sum = 0;
  std::uint32_t used = 0;
  for (; used < buckets && sum < k; ++used) {
    if (counts_[used] > kCrowded) return false;
    sum += std::exchange(counts_[used], sum);
  }
  sorted_.resize(sum);
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (buckets_[i] < used) sorted_[counts_[buckets_[i]]++] = candidates[i];
  insertion_sort(sorted_);
  sorted_.resize(std::min<std::size_t>(sum, k));
  candidates.swap(sorted_);
  return true;
}

void Selector::first(std::vector<Neighbour>& candidates, std::size_t k, float limit2) {
  // Over a surface squared distances are spread evenly, so that buckets hold one or two each.
  if (candidates.size() > kFew && by_buckets(candidates, k, limit2)) return;
  if (candidates.size() > k) {
    const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(k);
    std::nth_element(candidates.begin(), end, candidates.end(), before);
    candidates.resize(k);
  }
  std::sort(candidates.begin(), candidates.end(), before);
}

}  // namespace velum::spatial
