// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/records.hpp"

#include <algorithm>

namespace velum::formats {

std::size_t size_of(FieldType type) {
  return with_type(type, [](auto value) { return sizeof(value); });
}

std::string_view name_of(FieldType type) {
  constexpr std::string_view kNames[] = {"i8",  "u8",  "i16", "u16", "i32",
                                         "u32", "i64", "u64", "f32", "f64"};
  return kNames[static_cast<std::size_t>(type)];
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

const Field* Records::find(std::string_view lower_name) const {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& field) {
    return lower(field.name) == lower_name;
  });
  return found == fields.end() ? nullptr : &*found;
}

void load_doubles(const Field& field, bool swapped, Index component, Index begin, Index count,
                  double* out) {
  with_type(field.type, [&](auto type) {
    using T = decltype(type);
    const std::byte* from = field.data + static_cast<std::size_t>(begin) * field.stride +
                            static_cast<std::size_t>(component) * sizeof(T);
    for (Index i = 0; i < count; ++i, from += field.stride)
      out[i] = static_cast<double>(load<T>(from, swapped));
  });
}

}  // namespace velum::formats
