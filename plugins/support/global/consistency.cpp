// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "global/consistency.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace velum::registration {
namespace {

bool consistent(const Match& a, const Match& b, const ConsistencyGraph::Limits& limits) {
  const Eigen::Vector3d from = b.from - a.from;
  const Eigen::Vector3d to = b.to - a.to;
  const double from_length = from.norm();
  const double to_length = to.norm();
  // Written so that what is no number is not consistent with anything.
  if (!(from_length >= limits.shortest && to_length >= limits.shortest &&
        std::abs(from_length - to_length) <= limits.length))
    return false;
  const auto differ = [&](double x, double y) { return !(std::abs(x - y) <= limits.cosine); };
  if (differ(a.from_normal.dot(b.from_normal), a.to_normal.dot(b.to_normal)) ||
      differ(a.from_normal.dot(from) / from_length, a.to_normal.dot(to) / to_length) ||
      differ(b.from_normal.dot(from) / from_length, b.to_normal.dot(to) / to_length))
    return false;
  // Mirror images agree in all of these.
  return !differ(a.from_normal.cross(b.from_normal).dot(from) / from_length,
                 a.to_normal.cross(b.to_normal).dot(to) / to_length);
}

}  // namespace

ConsistencyGraph::ConsistencyGraph(const std::vector<Match>& matches, const Limits& limits,
                                   Context& context)
    : size_(matches.size()), words_((matches.size() + 63) / 64) {
  bits_.assign(size_ * words_, 0);
  parallel_for(context, static_cast<Index>(size_), 32, [&](Index begin, Index end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      for (std::size_t j = i + 1; j < size_; ++j)
        if (consistent(matches[i], matches[j], limits))
          bits_[i * words_ + j / 64] |= std::uint64_t{1} << (j % 64);
  });
  degree_.assign(size_, 0);
  for (std::size_t i = 0; i < size_; ++i)
    for (std::size_t w = i / 64; w < words_; ++w)
      for (std::uint64_t rest = bits_[i * words_ + w]; rest != 0; rest &= rest - 1) {
        const std::size_t j = 64 * w + static_cast<std::size_t>(std::countr_zero(rest));
        if (j <= i) continue;
        bits_[j * words_ + i / 64] |= std::uint64_t{1} << (i % 64);
        ++degree_[i];
        ++degree_[j];
      }
}

std::vector<int> ConsistencyGraph::core_numbers() const {
  std::vector<int> left = degree_;
  std::vector<std::vector<std::int32_t>> by_degree(size_ + 1);
  for (std::size_t i = 0; i < size_; ++i)
    by_degree[static_cast<std::size_t>(left[i])].push_back(static_cast<std::int32_t>(i));
  std::vector<char> gone(size_, 0);
  std::vector<int> core(size_, 0);
  int now = 0;
  for (std::size_t d = 0; d < by_degree.size();) {
    if (by_degree[d].empty()) {
      ++d;
      continue;
    }
    const auto i = static_cast<std::size_t>(by_degree[d].back());
    by_degree[d].pop_back();
    if (gone[i] != 0 || static_cast<std::size_t>(left[i]) != d) continue;
    gone[i] = 1;
    now = std::max(now, static_cast<int>(d));
    core[i] = now;
    for (std::size_t w = 0; w < words_; ++w)
      for (std::uint64_t rest = row(i)[w]; rest != 0; rest &= rest - 1) {
        const std::size_t j = 64 * w + static_cast<std::size_t>(std::countr_zero(rest));
        if (gone[j] != 0) continue;
        --left[j];
        by_degree[static_cast<std::size_t>(left[j])].push_back(static_cast<std::int32_t>(j));
      }
    d = d > 0 ? d - 1 : 0;
  }
  return core;
}

std::vector<std::int32_t> ConsistencyGraph::clique_of(std::size_t seed) const {
  std::vector<std::int32_t> clique{static_cast<std::int32_t>(seed)};
  std::vector<std::uint64_t> open(row(seed), row(seed) + words_);
  while (true) {
    int most = -1;
    std::size_t best = 0;
    for (std::size_t w = 0; w < words_; ++w)
      for (std::uint64_t rest = open[w]; rest != 0; rest &= rest - 1) {
        const std::size_t j = 64 * w + static_cast<std::size_t>(std::countr_zero(rest));
        int common = 0;
        for (std::size_t v = 0; v < words_; ++v) common += std::popcount(open[v] & row(j)[v]);
        if (common > most) {
          most = common;
          best = j;
        }
      }
    if (most < 0) return clique;
    clique.push_back(static_cast<std::int32_t>(best));
    for (std::size_t v = 0; v < words_; ++v) open[v] &= row(best)[v];
  }
}

}  // namespace velum::registration
