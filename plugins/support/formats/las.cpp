// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/las.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/attributes.hpp"
#include "formats/positions.hpp"

namespace velum::formats {
namespace {

constexpr Index kGrain = 65536;

/// What a point format holds, by its number: length, place of time and colour (0: none).
struct PointFormat {
  std::size_t length;
  std::size_t classification;
  std::size_t time;
  std::size_t colour;
};
constexpr PointFormat kPointFormats[] = {{20, 15, 0, 0},   {28, 15, 20, 0},  {26, 15, 0, 20},
                                         {34, 15, 20, 28}, {57, 15, 20, 0},  {63, 15, 20, 28},
                                         {30, 16, 22, 0},  {36, 16, 22, 30}, {38, 16, 22, 30},
                                         {59, 16, 22, 0},  {67, 16, 22, 30}};

struct Header {
  PointFormat format{};
  std::size_t first = 0;   ///< where the points begin
  std::size_t stride = 0;  ///< bytes a point
  Index points = 0;
  std::array<double, 3> scale{};
  std::array<double, 3> offset{};
};

class HeaderReader {
 public:
  explicit HeaderReader(const Source& source) : source_(source) {}

  Header read() {
    constexpr std::size_t kShortest = 227;
    if (source_.size() < kShortest)
      throw source_.bad_byte(source_.size(),
                             fmt::format("a LAS header has at least {} bytes, found "
                                         "{}",
                                         kShortest, source_.size()));
    const auto major = get<std::uint8_t>(24);
    const auto minor = get<std::uint8_t>(25);
    if (major != 1 || minor > 4)
      throw source_.bad_byte(24,
                             fmt::format("LAS version {}.{}, expected 1.0 to 1.4", major, minor));
    read_format();
    read_count(minor);
    read_grid();
    check_length();
    return header_;
  }

 private:
  template <class T>
  T get(std::size_t at) const {
    return load<T>(source_.bytes().data() + at, false);
  }

  void read_format() {
    const auto format = get<std::uint8_t>(104);
    if ((format & 0xC0U) != 0)
      throw source_.bad_byte(104, "the points are compressed (LAZ), which is not read")
          .hint("unpack it first, for instance with laszip");
    if (format >= std::size(kPointFormats))
      throw source_.bad_byte(104, fmt::format("point format {}, expected 0 to 10", format));
    header_.format = kPointFormats[format];
    header_.stride = get<std::uint16_t>(105);
    if (header_.stride < header_.format.length)
      throw source_.bad_byte(105, fmt::format("points of {} bytes; format {} has at least {}",
                                              header_.stride, format, header_.format.length));
  }

  /// LAS 1.4 has a count of 64 bits; the older one may be zero then.
  void read_count(unsigned minor) {
    constexpr std::size_t kHeader14 = 375;
    std::uint64_t count = get<std::uint32_t>(107);
    if (minor == 4 && source_.size() >= kHeader14 && get<std::uint16_t>(94) >= kHeader14)
      count = get<std::uint64_t>(247);
    if (count > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max()))
      throw source_.bad_byte(107, fmt::format("{} points; at most 2147483647 are possible", count));
    header_.points = static_cast<Index>(count);
  }

  void read_grid() {
    for (std::size_t a = 0; a < 3; ++a) {
      header_.scale[a] = get<double>(131 + 8 * a);
      header_.offset[a] = get<double>(155 + 8 * a);
      if (!(std::abs(header_.scale[a]) > 0.0 && std::abs(header_.scale[a]) < 1e6))
        throw source_.bad_byte(131 + 8 * a,
                               fmt::format("a scale of {}, expected one that is finite "
                                           "and not zero",
                                           header_.scale[a]));
      if (!(std::abs(header_.offset[a]) < kLargestCoordinate / 2.0))
        throw source_.bad_byte(155 + 8 * a, fmt::format("an offset of {}", header_.offset[a]));
    }
  }

  void check_length() {
    const auto header_size = get<std::uint16_t>(94);
    header_.first = get<std::uint32_t>(96);
    if (header_.first < header_size || header_size < 227 || header_.first > source_.size())
      throw source_.bad_byte(96, fmt::format("points at byte {} of {} behind a header of {} bytes",
                                             header_.first, source_.size(), header_size));
    const std::size_t found = source_.size() - header_.first;
    const std::size_t expected = static_cast<std::size_t>(header_.points) * header_.stride;
    if (expected > found)
      throw source_.bad_byte(source_.size(),
                             fmt::format("the file ends after {} of {} bytes of "
                                         "points ({} of {} bytes)",
                                         found, expected, header_.points, header_.stride));
  }

  const Source& source_;
  Header header_;
};

/// Smallest and largest whole coordinate of each axis.
struct Span {
  Eigen::Array3i low = Eigen::Array3i::Constant(std::numeric_limits<int>::max());
  Eigen::Array3i high = Eigen::Array3i::Constant(std::numeric_limits<int>::min());
};

Eigen::Array3i whole_at(const std::byte* point) {
  return {load<std::int32_t>(point, false), load<std::int32_t>(point + 4, false),
          load<std::int32_t>(point + 8, false)};
}

Span span_of(const std::byte* points, const Header& header, Context& context) {
  return parallel_reduce(
      context, header.points, kGrain, Span{},
      [&](Index begin, Index end) {
        Span part;
        for (Index i = begin; i < end; ++i) {
          const Eigen::Array3i whole =
              whole_at(points + static_cast<std::size_t>(i) * header.stride);
          part.low = part.low.min(whole);
          part.high = part.high.max(whole);
        }
        return part;
      },
      [](Span& all, const Span& part) {
        all.low = all.low.min(part.low);
        all.high = all.high.max(part.high);
      });
}

/// The whole coordinate that becomes the origin of an axis, in the middle of its span; nothing
/// where coordinates are small enough to do without an origin.
std::optional<std::int64_t> centre_of(const Header& header, std::size_t axis, int low, int high,
                                      double unit) {
  constexpr double kExact = 4194304.0;  // 2^22 steps: a quarter of what a float tells apart
  const double scale = header.scale[axis];
  const double a = low * scale + header.offset[axis];
  const double b = high * scale + header.offset[axis];
  const double largest = std::max(std::abs(a), std::abs(b));
  if (choose_origin(std::min(a, b) * unit, std::max(a, b) * unit) == 0.0 &&
      largest < kExact * std::abs(scale))
    return std::nullopt;
  return (std::int64_t{low} + std::int64_t{high}) / 2;
}

Cloud read_positions(const Source& source, const Header& header, double unit, Context& context) {
  const std::byte* points = source.bytes().data() + header.first;
  const Span span = span_of(points, header, context);
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::array<std::int64_t, 3> centre{};
  std::array<double, 3> rest{};  // what is added to (whole - centre) * scale
  bool exact = true;
  for (std::size_t a = 0; a < 3 && header.points > 0; ++a) {
    const auto axis = static_cast<Index>(a);
    const auto middle = centre_of(header, a, span.low[axis], span.high[axis], unit);
    centre[a] = middle.value_or(0);
    const double place = header.offset[a] + static_cast<double>(centre[a]) * header.scale[a];
    (middle ? origin[axis] : rest[a]) = place * unit;
    const std::int64_t reach =
        std::max(std::int64_t{span.high[axis]} - centre[a], centre[a] - span.low[axis]);
    exact = exact && reach < (std::int64_t{1} << 23U);
  }
  if (!exact)
    context.warn(source.name() +
                 ": the cloud is so large that single precision cannot tell apart "
                 "all steps of the file's scale");
  Points positions(3, header.points);
  parallel_for(context, header.points, kGrain, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const Eigen::Array3i whole = whole_at(points + static_cast<std::size_t>(i) * header.stride);
      for (std::size_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<Index>(a);
        const auto steps = static_cast<double>(std::int64_t{whole[axis]} - centre[a]);
        positions(axis, i) = static_cast<float>(steps * header.scale[a] * unit + rest[a]);
      }
    }
  });
  return Cloud(std::move(positions), origin);
}

Records attributes_of(const Source& source, const Header& header) {
  const std::byte* points = source.bytes().data() + header.first;
  Records records;
  records.count = header.points;
  const auto add = [&](const char* name, FieldType type, std::size_t at) {
    records.fields.push_back({name, type, 1, points + at, header.stride});
  };
  add("intensity", FieldType::u16, 12);
  add("label", FieldType::u8, header.format.classification);
  if (header.format.time != 0) add("time", FieldType::f64, header.format.time);
  if (header.format.colour != 0) {
    add("red", FieldType::u16, header.format.colour);
    add("green", FieldType::u16, header.format.colour + 2);
    add("blue", FieldType::u16, header.format.colour + 4);
  }
  return records;
}

/// Formats 0 to 5 keep flags in the upper three bits of the classification.
Column without_flags(const Column& labels) {
  return Column(Eigen::VectorXi(
      labels.vector<std::int32_t>().unaryExpr([](std::int32_t label) { return label & 31; })));
}

}  // namespace

Cloud read_las(const Source& source, const ReadOptions& options, Context& context) {
  const Header header = HeaderReader(source).read();
  if (options.left_handed)
    throw Error(Fault::graph, "LAS coordinates are right-handed").at(source.name());
  Cloud cloud = read_positions(source, header, options.unit, context);
  const Records records = attributes_of(source, header);
  for (auto& [name, column] :
       read_attributes(records, {header.points, nullptr}, {}, false, context)) {
    const bool flagged = name == column::kLabel && header.format.classification == 15;
    cloud = cloud.with(name, flagged ? without_flags(column) : column);
  }
  context.measure("dropped", 0.0, "", Better::lower);
  return cloud;
}

}  // namespace velum::formats
