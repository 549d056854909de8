// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>

#include "formats/out_fields.hpp"
#include "formats/rows.hpp"

namespace velum::formats {
namespace {

/// Points a piece; pieces that are made before they are written.
constexpr Index kRowGrain = 65536;
constexpr Index kLineGrain = 8192;
constexpr Index kWave = 16;

void swap_row(const OutFields& fields, char* row) {
  for (const OutField& field : fields) {
    const std::size_t size = size_of(field.type);
    for (Index i = 0; i < field.width; ++i, row += size) std::reverse(row, row + size);
  }
}

template <class T>
void append_plain(std::string& text, T value) {
  char digits[64];
  const auto result = std::to_chars(digits, digits + sizeof(digits), value);
  text.append(digits, result.ptr);
}

void append_value(std::string& text, FieldType type, const std::byte* from) {
  with_type(type, [&](auto typed) {
    using T = decltype(typed);
    if constexpr (std::is_floating_point_v<T>)
      append_plain(text, load<T>(from, false));
    else
      append_plain(text, static_cast<std::int64_t>(load<T>(from, false)));
  });
}

void append_row(std::string& text, const OutFields& fields, const std::byte* row, char separator) {
  for (const OutField& field : fields) {
    for (Index i = 0; i < field.width; ++i, row += size_of(field.type)) {
      append_value(text, field.type, row);
      text += separator;
    }
  }
  text.back() = '\n';
}

}  // namespace

void write_pieces(AtomicFile& file, Index count, Index grain, Context& context,
                  const std::function<std::string(Index begin, Index end)>& make) {
  const Index pieces = (count + grain - 1) / grain;
  std::vector<std::string> made(static_cast<std::size_t>(std::min(pieces, kWave)));
  for (Index first = 0; first < pieces; first += kWave) {
    const Index wave = std::min(kWave, pieces - first);
    context.run_chunks(wave, [&](Index i) {
      const Index begin = (first + i) * grain;
      made[static_cast<std::size_t>(i)] = make(begin, std::min(count, begin + grain));
    });
    for (Index i = 0; i < wave; ++i)
      file.write(std::string_view(made[static_cast<std::size_t>(i)]));
    context.progress(static_cast<double>(first + wave) / static_cast<double>(pieces));
  }
}

void write_rows(AtomicFile& file, const OutFields& fields, Index count, bool swapped,
                Context& context) {
  const std::size_t stride = stride_of(fields);
  write_pieces(file, count, kRowGrain, context, [&](Index begin, Index end) {
    std::string rows(static_cast<std::size_t>(end - begin) * stride, '\0');
    fill_rows(fields, begin, end, reinterpret_cast<std::byte*>(rows.data()));  // NOLINT
    if (swapped)
      for (std::size_t at = 0; at < rows.size(); at += stride) swap_row(fields, rows.data() + at);
    return rows;
  });
}

void write_lines(AtomicFile& file, const OutFields& fields, Index count, char separator,
                 Context& context) {
  const std::size_t stride = stride_of(fields);
  write_pieces(file, count, kLineGrain, context, [&](Index begin, Index end) {
    const auto points = static_cast<std::size_t>(end - begin);
    const Buffer rows(points * stride);
    fill_rows(fields, begin, end, rows.data.get());
    std::string text;
    text.reserve(points * fields.size() * 12);
    for (std::size_t i = 0; i < points; ++i)
      append_row(text, fields, rows.data.get() + i * stride, separator);
    return text;
  });
}

void append_number(std::string& text, double value) {
  append_plain(text, value);
}
void append_number(std::string& text, float value) {
  append_plain(text, value);
}
void append_number(std::string& text, std::int64_t value) {
  append_plain(text, value);
}

}  // namespace velum::formats
