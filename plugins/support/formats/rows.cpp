// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/rows.hpp"

#include <fmt/format.h>

#include <limits>

namespace velum::formats {
namespace {

template <class T>
void store(std::byte* to, T value) {
  std::memcpy(to, &value, sizeof(T));
}

const char* skip(const char* at, const char* end, const RowLayout& layout) {
  while (at != end && (is_blank(*at) || (layout.loose && *at == ','))) ++at;
  return at;
}

bool ends_value(const char* at, const char* end, const RowLayout& layout) {
  return at == end || is_blank(*at) || *at == layout.separator || (layout.loose && *at == ',');
}

std::string_view word_at(const char* at, const char* end, const RowLayout& layout) {
  const char* stop = at;
  while (!ends_value(stop, end, layout)) ++stop;
  return {at, static_cast<std::size_t>(stop - at)};
}

[[noreturn]] void refuse_value(const Source& source, std::string_view line, std::size_t item,
                               const RowLayout& layout, const char* at) {
  const char* end = line.data() + line.size();
  if (at == end)
    throw source.bad_line(line,
                          fmt::format("found {} values, expected {}", item, layout.items.size()));
  throw source.bad_line(
      line, fmt::format("value {} is {}, expected a number of type {}", item + 1,
                        quote(word_at(at, end, layout)), name_of(layout.items[item].type)));
}

}  // namespace

const char* parse_value(const char* begin, const char* end, FieldType type, std::byte* to) {
  if (type == FieldType::f64) {
    double value = 0.0;
    end = parse_real(begin, end, value);
    store(to, value);
    return end;
  }
  if (type == FieldType::f32) {
    float value = 0.0F;
    end = parse_real(begin, end, value);
    store(to, value);
    return end;
  }
  std::int64_t value = 0;
  const char* stop = parse_integer(begin, end, value);
  if (stop == nullptr) return nullptr;
  const bool fits = with_type(type, [&](auto typed) {
    using T = decltype(typed);
    if constexpr (std::is_integral_v<T> && sizeof(T) < sizeof(value)) {
      if (value < std::numeric_limits<T>::min() || value > std::numeric_limits<T>::max())
        return false;
    }
    if (std::is_unsigned_v<T> && value < 0) return false;
    store(to, static_cast<T>(value));
    return true;
  });
  return fits ? stop : nullptr;
}

void parse_row(const Source& source, std::string_view line, const RowLayout& layout,
               std::byte* row) {
  const char* at = line.data();
  const char* end = at + line.size();
  for (std::size_t i = 0; i < layout.items.size(); ++i) {
    const RowLayout::Item& item = layout.items[i];
    at = skip(at, end, layout);
    const bool empty = layout.empty_is_nan && i + 1 <= layout.items.size() &&
                       (at == end || *at == layout.separator);
    if (empty) {
      store(row + item.offset, std::numeric_limits<double>::quiet_NaN());
    } else {
      const char* stop = parse_value(at, end, item.type, row + item.offset);
      if (stop == nullptr || !ends_value(stop, end, layout))
        refuse_value(source, line, i, layout, at);
      at = skip(stop, end, layout);
    }
    if (layout.separator == ' ' || i + 1 == layout.items.size()) continue;
    if (at == end || *at != layout.separator)
      throw source.bad_line(
          line, fmt::format("found {} values, expected {}", i + 1, layout.items.size()));
    ++at;
  }
  if (skip(at, end, layout) != end)
    throw source.bad_line(
        line, fmt::format("found {} after the {} values expected",
                          quote({at, static_cast<std::size_t>(end - at)}), layout.items.size()));
}

Buffer parse_rows(const Source& source, const Lines& lines, Index first, Index count,
                  const RowLayout& layout, Context& context) {
  // A value takes a character at least: no header can make us allocate more than the text deserves.
  std::size_t characters = 0;
  for (const Lines::Block& block : lines.blocks) characters += block.text.size();
  if (static_cast<std::size_t>(count) * layout.items.size() > characters + 1)
    throw Error(Fault::input, fmt::format("{} lines of {} values do not fit into {} characters",
                                          count, layout.items.size(), characters))
        .at(source.name());
  Buffer rows(static_cast<std::size_t>(count) * layout.stride);
  context.run_chunks(static_cast<Index>(lines.blocks.size()), [&](Index i) {
    const Lines::Block& block = lines.blocks[static_cast<std::size_t>(i)];
    if (block.first + block.count <= first || block.first >= first + count) return;
    each_line(lines, block, [&](std::string_view line, Index number) {
      if (number < first || number >= first + count) return;
      parse_row(source, line, layout,
                rows.data.get() + static_cast<std::size_t>(number - first) * layout.stride);
    });
  });
  return rows;
}

}  // namespace velum::formats
