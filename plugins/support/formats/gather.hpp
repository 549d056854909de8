// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "formats/memory.hpp"
#include "formats/records.hpp"
#include "velum/context.hpp"

namespace velum::formats {

/// One component of a field: a single value a record.
struct Component {
  const Field* field = nullptr;
  Index index = 0;
};

/// What values a component has.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool whole = true;   ///< all are whole numbers
  bool finite = true;  ///< none is NaN or infinite
  [[nodiscard]] bool fits_i32() const {
    return whole && (low > high || (low >= -2147483648.0 && high <= 2147483647.0));
  }
  [[nodiscard]] bool within(double least, double most) const {
    return finite && (low > high || (low >= least && high <= most));
  }
};

inline constexpr Index kGatherGrain = 65536;
inline constexpr Index kGatherTile = 1024;

/// Calls visit(begin, values, count) over the kept records of [begin, end) in pieces.
template <class Visit>
void each_piece(const Records& records, const Component& component, const Kept& kept, Index begin,
                Index end, const Visit& visit) {
  double values[kGatherTile];
  for (Index at = begin; at < end; at += kGatherTile) {
    const Index count = std::min(kGatherTile, end - at);
    if (kept.list == nullptr) {
      load_doubles(*component.field, records.swapped, component.index, at, count, values);
    } else {
      for (Index i = 0; i < count; ++i)
        load_doubles(*component.field, records.swapped, component.index, kept.list[at + i], 1,
                     values + i);
    }
    visit(at, values, count);
  }
}

Extent extent_of(const Records& records, const Component& component, const Kept& kept,
                 Context& context);

/// The components as one column of D, each value through convert(value, component).
template <class D, class Convert>
Column gather(const Records& records, std::span<const Component> components, const Kept& kept,
              Context& context, const Convert& convert) {
  const auto width = static_cast<Index>(components.size());
  Eigen::Matrix<D, Eigen::Dynamic, Eigen::Dynamic> values(width, kept.count);
  prefer_huge_pages(values.data(), static_cast<std::size_t>(values.size()) * sizeof(D));
  parallel_for(context, kept.count, kGatherGrain, [&](Index begin, Index end) {
    for (Index c = 0; c < width; ++c)
      each_piece(records, components[static_cast<std::size_t>(c)], kept, begin, end,
                 [&](Index at, const double* from, Index n) {
                   for (Index i = 0; i < n; ++i)
                     values(c, at + i) = static_cast<D>(convert(from[i], c));
                 });
  });
  return Column(std::move(values));
}

}  // namespace velum::formats
