// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>

#include "formats/gather.hpp"
#include "formats/rows.hpp"
#include "formats/text.hpp"
#include "formats/text_layout.hpp"

namespace velum::formats {
namespace {

/// Names for columns that nobody named, by what their values can be: after x y z come a colour
/// (whole numbers to 255), a normal (unit length), an intensity; or an intensity and a colour.
class Guess {
 public:
  Guess(const Records& records, Context& context)
      : records_(records), kept_{records.count, nullptr}, context_(context) {}

  std::vector<std::string> names() {
    const std::size_t columns = records_.fields.size();
    std::vector<std::string> names = {"x", "y", "z"};
    const auto add = [&](std::initializer_list<const char*> more) {
      names.insert(names.end(), more.begin(), more.end());
    };
    if (columns == 6 && is_colour(3))
      add({"red", "green", "blue"});
    else if (columns == 6 && is_normal(3))
      add({"nx", "ny", "nz"});
    else if (columns == 7 && is_colour(4))
      add({"intensity", "red", "green", "blue"});
    else if (columns == 9 && is_colour(3) && is_normal(6))
      add({"red", "green", "blue", "nx", "ny", "nz"});
    else if (columns == 10 && is_colour(4) && is_normal(7))
      add({"intensity", "red", "green", "blue", "nx", "ny", "nz"});
    else if (columns == 4)
      add({"intensity"});
    while (names.size() < columns) names.push_back(fmt::format("column_{}", names.size() + 1));
    return names;
  }

 private:
  bool is_colour(std::size_t first) {
    for (std::size_t i = first; i < first + 3; ++i) {
      const Extent extent = extent_of(records_, {&records_.fields[i], 0}, kept_, context_);
      if (!extent.whole || !extent.within(0.0, 255.0)) return false;
    }
    return true;
  }

  bool is_normal(std::size_t first) {
    constexpr double kTolerance = 0.01;
    constexpr Index kLooked = 1000;
    for (Index i = 0; i < std::min(records_.count, kLooked); ++i) {
      double squared = 0.0;
      for (std::size_t f = first; f < first + 3; ++f) {
        double value = 0.0;
        load_doubles(records_.fields[f], false, 0, i, 1, &value);
        squared += value * value;
      }
      if (!(std::abs(std::sqrt(squared) - 1.0) < kTolerance)) return false;
    }
    return true;
  }

  const Records& records_;
  Kept kept_;
  Context& context_;
};

}  // namespace

Cloud read_text(Source& source, const ReadOptions& options, Context& context) {
  const TextLayout text = read_text_layout(source, options.columns);
  const Lines lines = split_lines(source.text().substr(text.body), true, context);
  if (text.points && *text.points != lines.count)
    throw source.bad_line(source.size(), fmt::format("found {} lines of points, expected {} (first "
                                                     "line)",
                                                     lines.count, *text.points));
  RowLayout layout;
  layout.separator = text.separator;
  layout.empty_is_nan = text.separator != ' ';
  for (std::size_t i = 0; i < text.columns; ++i) layout.add(FieldType::f64);
  const Buffer rows = parse_rows(source, lines, 0, lines.count, layout, context);
  source.release();

  Records records;
  records.count = lines.count;
  records.untyped = true;
  records.sensors = text.sensors;
  for (std::size_t i = 0; i < text.columns; ++i)
    records.fields.push_back(
        {"", FieldType::f64, 1, rows.data.get() + i * sizeof(double), layout.stride});
  const std::vector<std::string> names =
      text.names.empty() ? Guess(records, context).names() : text.names;
  for (std::size_t i = 0; i < names.size(); ++i)
    records.fields[i].name = names[i].empty() ? fmt::format("column_{}", i + 1) : names[i];
  return assemble(source, records, options, NotFinite::drop, context);
}

}  // namespace velum::formats
