// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "velum/api.hpp"
#include "velum/types.hpp"

namespace velum {

class Context;

/// One answer of a neighbour query: index of the point and its squared distance [m²].
struct Neighbour {
  std::int32_t index;
  float distance2;
};

/// Nearest-neighbour index over a fixed set of positions.
///
/// Answers are exact, ascending by (distance, index), and the same whatever the number of threads.
/// A point of the set is its own first neighbour. Queries are const and thread-safe. Indices are
/// those of the caller's positions, which the index keeps no reference to.
class VELUM_API Neighbours {
 public:
  /// Called once per query with its number and its neighbours (valid during the call only); calls
  /// come from several threads, in no order.
  using Visitor = std::function<void(Index query, std::span<const Neighbour>)>;

  explicit Neighbours(const ConstPoints& positions);
  ~Neighbours();
  Neighbours(const Neighbours&) = delete;
  Neighbours& operator=(const Neighbours&) = delete;

  [[nodiscard]] Index size() const;

  /// The `k` nearest points (fewer when the set is smaller), into `out`.
  void nearest(const Eigen::Vector3f& query, Index k, std::vector<Neighbour>& out) const;
  /// All points at most `radius` [m] away, into `out`.
  void within(const Eigen::Vector3f& query, double radius, std::vector<Neighbour>& out) const;
  /// The nearest point closer than `radius`; index -1 when there is none.
  [[nodiscard]] Neighbour nearest_one(const Eigen::Vector3f& query, double radius) const;

  /// Neighbours of every point of the set, in parallel and in an order kind to the memory. This is
  /// the fast way: prefer it to a loop over single queries. Throws Cancelled on interruption.
  void each_nearest(Index k, Context& context, const Visitor& visit) const;
  void each_within(double radius, Context& context, const Visitor& visit) const;
  /// The same for positions that are not of the set.
  void each_nearest(const ConstPoints& queries, Index k, Context& context,
                    const Visitor& visit) const;
  void each_within(const ConstPoints& queries, double radius, Context& context,
                   const Visitor& visit) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace velum
