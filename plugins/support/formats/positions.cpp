// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/positions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/memory.hpp"

namespace velum::formats {
namespace {

/// Records a range of parallel_for, and records that are looked at together.
constexpr Index kGrain = 65536;
constexpr Index kTile = 512;

struct Tile {
  double axis[3][kTile];
};

void load_tile(const Records& records, const Axes& axes, Index begin, Index count, Tile& tile) {
  for (std::size_t a = 0; a < 3; ++a) {
    load_doubles(*axes[a].field, records.swapped, axes[a].component, begin, count, tile.axis[a]);
    if (axes[a].factor != 1.0)
      for (Index i = 0; i < count; ++i) tile.axis[a][i] *= axes[a].factor;
  }
}

bool is_position(const Tile& tile, Index i) {
  // Not a number fails every comparison.
  return std::abs(tile.axis[0][i]) <= kLargestCoordinate &&
         std::abs(tile.axis[1][i]) <= kLargestCoordinate &&
         std::abs(tile.axis[2][i]) <= kLargestCoordinate;
}

/// What the first pass learns of a range.
struct Survey {
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low;
  Index finite = 0;

  void add(const Survey& other) {
    low = low.min(other.low);
    high = high.max(other.high);
    finite += other.finite;
  }
};

Survey survey(const Records& records, const Axes& axes, Index begin, Index end) {
  Survey result;
  Tile tile;
  for (Index at = begin; at < end; at += kTile) {
    const Index count = std::min(kTile, end - at);
    load_tile(records, axes, at, count, tile);
    for (Index i = 0; i < count; ++i) {
      if (!is_position(tile, i)) continue;
      ++result.finite;
      for (Index a = 0; a < 3; ++a) {
        result.low[a] = std::min(result.low[a], tile.axis[a][i]);
        result.high[a] = std::max(result.high[a], tile.axis[a][i]);
      }
    }
  }
  return result;
}

/// Are the coordinates three single-precision numbers side by side, to be taken as they are?
bool are_plain(const Records& records, const Axes& axes) {
  const Field& x = *axes[0].field;
  for (std::size_t a = 0; a < 3; ++a) {
    const Field& field = *axes[a].field;
    const bool beside = field.data == x.data + a * sizeof(float) && field.stride == x.stride;
    if (field.type != FieldType::f32 || axes[a].component != 0 || axes[a].factor != 1.0 || !beside)
      return false;
  }
  return !records.swapped;
}

/// Smallest and largest of what stands at the same place in groups of four points: a form that the
/// compiler turns into vector code.
struct Lanes {
  static constexpr Index kWidth = 12;
  float low[kWidth];
  float high[kWidth];

  Lanes() {
    std::fill(low, low + kWidth, std::numeric_limits<float>::infinity());
    std::fill(high, high + kWidth, -std::numeric_limits<float>::infinity());
  }

  /// Takes four points; false, and nothing taken, when a coordinate is none.
  bool add(const float* values) {
    constexpr auto kLargest = static_cast<float>(kLargestCoordinate);
    unsigned bad = 0;
    for (Index i = 0; i < kWidth; ++i) bad |= std::abs(values[i]) <= kLargest ? 0U : 1U;
    if (bad != 0) return false;
    for (Index i = 0; i < kWidth; ++i) {
      low[i] = values[i] < low[i] ? values[i] : low[i];
      high[i] = values[i] > high[i] ? values[i] : high[i];
    }
    return true;
  }

  void give(Survey& to) const {
    for (Index i = 0; i < kWidth; ++i) {
      to.low[i % 3] = std::min(to.low[i % 3], static_cast<double>(low[i]));
      to.high[i % 3] = std::max(to.high[i % 3], static_cast<double>(high[i]));
    }
  }
};

void survey_points(const float* points, Index count, Survey& result) {
  for (Index i = 0; i < count; ++i, points += 3) {
    const Eigen::Array3d place(static_cast<double>(points[0]), static_cast<double>(points[1]),
                               static_cast<double>(points[2]));
    if (!(place.abs() <= kLargestCoordinate).all()) continue;
    ++result.finite;
    result.low = result.low.min(place);
    result.high = result.high.max(place);
  }
}

/// Copies the points of a range to `out` and surveys them on the way.
Survey copy_range(const Field& x, Index begin, Index end, float* out) {
  constexpr Index kGroup = Lanes::kWidth / 3;
  Survey result;
  Lanes lanes;
  const std::byte* from = x.data + static_cast<std::size_t>(begin) * x.stride;
  Index i = begin;
  for (; i + kGroup <= end; i += kGroup, out += Lanes::kWidth) {
    for (Index p = 0; p < kGroup; ++p, from += x.stride)
      std::memcpy(out + 3 * p, from, 3 * sizeof(float));
    if (lanes.add(out))
      result.finite += kGroup;
    else
      survey_points(out, kGroup, result);
  }
  lanes.give(result);
  for (Index p = i; p < end; ++p, from += x.stride)
    std::memcpy(out + 3 * (p - i), from, 3 * sizeof(float));
  survey_points(out, end - i, result);
  return result;
}

/// Writes the points of a range to `out` and their records to `kept` (unless null); returns the
/// largest rounding error.
double write_range(const Records& records, const Axes& axes, Index begin, Index end,
                   const Eigen::Vector3d& origin, float* out, std::int32_t* kept) {
  double rounding = 0.0;
  Tile tile;
  for (Index at = begin; at < end; at += kTile) {
    const Index count = std::min(kTile, end - at);
    load_tile(records, axes, at, count, tile);
    for (Index i = 0; i < count; ++i) {
      if (kept != nullptr) {
        if (!is_position(tile, i)) continue;
        *kept++ = static_cast<std::int32_t>(at + i);
      }
      for (Index a = 0; a < 3; ++a) {
        const double offset = tile.axis[a][i] - origin[a];
        *out = static_cast<float>(offset);
        rounding = std::max(rounding, std::abs(static_cast<double>(*out++) - offset));
      }
    }
  }
  return rounding;
}

}  // namespace

double choose_origin(double low, double high) {
  constexpr double kLarge = 1000.0;
  constexpr double kFarAway = 4.0;
  const double largest = std::max(std::abs(low), std::abs(high));
  if (!(largest > kLarge && largest > kFarAway * (high - low) / 2.0)) return 0.0;
  const auto rounded = static_cast<float>(largest);
  const double step = std::nextafter(rounded, std::numeric_limits<float>::infinity()) - rounded;
  const double grid = std::max(1.0, step);
  return std::round((low + high) / 2.0 / grid) * grid;
}

Positions read_positions(const Records& records, const Axes& axes, Context& context) {
  const auto ranges = static_cast<std::size_t>((records.count + kGrain - 1) / kGrain);
  std::vector<Survey> surveys(ranges);
  Positions result;
  const auto make_room = [&](Index count) {
    result.points.resize(3, count);
    prefer_huge_pages(result.points.data(), static_cast<std::size_t>(3 * count) * sizeof(float));
  };
  const bool plain = are_plain(records, axes);
  if (plain) make_room(records.count);
  parallel_for(context, records.count, kGrain, [&](Index begin, Index end) {
    surveys[static_cast<std::size_t>(begin / kGrain)] =
        plain ? copy_range(*axes[0].field, begin, end, result.points.data() + 3 * begin)
              : survey(records, axes, begin, end);
  });
  Survey total;
  std::vector<Index> first(ranges);  // where each range's points go
  for (std::size_t i = 0; i < ranges; ++i) {
    first[i] = total.finite;
    total.add(surveys[i]);
  }

  result.dropped = records.count - total.finite;
  if (total.finite > 0)
    for (Index a = 0; a < 3; ++a) result.origin[a] = choose_origin(total.low[a], total.high[a]);
  if (plain && result.dropped == 0 && result.origin.isZero(0.0)) return result;
  make_room(total.finite);
  if (total.finite == 0) return result;
  if (result.dropped > 0) result.kept.resize(static_cast<std::size_t>(total.finite));
  result.rounding = parallel_reduce(
      context, records.count, kGrain, 0.0,
      [&](Index begin, Index end) {
        const Index at = first[static_cast<std::size_t>(begin / kGrain)];
        return write_range(records, axes, begin, end, result.origin, result.points.data() + 3 * at,
                           result.dropped > 0 ? result.kept.data() + at : nullptr);
      },
      [](double& all, double part) { all = std::max(all, part); });
  return result;
}

}  // namespace velum::formats
