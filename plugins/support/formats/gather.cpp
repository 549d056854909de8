// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/gather.hpp"

namespace velum::formats {

Extent extent_of(const Records& records, const Component& component, const Kept& kept,
                 Context& context) {
  return parallel_reduce(
      context, kept.count, kGatherGrain, Extent{},
      [&](Index begin, Index end) {
        Extent part;
        each_piece(records, component, kept, begin, end, [&](Index, const double* values, Index n) {
          for (Index i = 0; i < n; ++i) {
            const double value = values[i];
            part.finite = part.finite && std::isfinite(value);
            part.whole = part.whole && std::trunc(value) == value;
            part.low = std::min(part.low, value);
            part.high = std::max(part.high, value);
          }
        });
        return part;
      },
      [](Extent& all, const Extent& part) {
        all.low = std::min(all.low, part.low);
        all.high = std::max(all.high, part.high);
        all.whole = all.whole && part.whole;
        all.finite = all.finite && part.finite;
      });
}

}  // namespace velum::formats
