// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "velum/error.hpp"
#include "velum/random.hpp"
#include "velum/types.hpp"

namespace velum {

/// Which direction of a measure is the good one.
enum class Better { lower, higher, neither };

/// What a stage may ask of the kernel while it runs. No stage prints, exits or touches global
/// state.
class VELUM_API Context {
 public:
  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  virtual ~Context();

  /// Threads that this node may use, at least 1; for libraries with threads of their own.
  [[nodiscard]] virtual int threads() const = 0;
  /// The node's random stream: a hash of run seed, stage and node name.
  [[nodiscard]] virtual Random random() const = 0;
  /// How much is done, 0 to 1; never goes back. Cheap, thread-safe.
  virtual void progress(double fraction) = 0;
  /// Has the run been interrupted? Cheap, thread-safe.
  [[nodiscard]] virtual bool cancelled() const noexcept = 0;
  /// Something the user should know, on the terminal and in the record.
  virtual void warn(const std::string& message) = 0;
  /// Something for the log.
  virtual void info(const std::string& message) = 0;
  /// A figure for the record, in SI units ("m", "rad", "m^2", "" for a count or share).
  virtual void measure(const std::string& name, double value, const std::string& unit,
                       Better better = Better::neither) = 0;
  /// Runs body(0) ... body(chunks - 1) on the node's threads, in any order. Checks for interruption
  /// between chunks; the first exception (by chunk number) is rethrown.
  virtual void run_chunks(Index chunks, const std::function<void(Index chunk)>& body) = 0;

  /// Throws Cancelled when the run was interrupted. Call it at least every 100 ms.
  void check() const {
    if (cancelled()) throw Cancelled();
  }
};

/// Calls body(begin, end) over [0, count) in ranges of `grain`; each range on one thread. Ranges do
/// not depend on the number of threads.
template <class Body>
void parallel_for(Context& context, Index count, Index grain, const Body& body) {
  if (count <= 0) return;
  grain = std::max<Index>(grain, 1);
  context.run_chunks((count + grain - 1) / grain, [&](Index chunk) {
    body(chunk * grain, std::min(count, (chunk + 1) * grain));
  });
}

/// Sums body(begin, end) over [0, count) with `combine(total, part)` in ascending order of ranges,
/// so that the result is the same for any number of threads.
template <class T, class Body, class Combine>
T parallel_reduce(Context& context, Index count, Index grain, T total, const Body& body,
                  const Combine& combine) {
  if (count <= 0) return total;
  grain = std::max<Index>(grain, 1);
  std::vector<T> parts(static_cast<std::size_t>((count + grain - 1) / grain), total);
  parallel_for(context, count, grain, [&](Index begin, Index end) {
    parts[static_cast<std::size_t>(begin / grain)] = body(begin, end);
  });
  for (T& part : parts) combine(total, part);
  return total;
}

}  // namespace velum
