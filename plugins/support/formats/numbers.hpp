// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <fast_float/fast_float.h>

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

namespace velum::formats {

/// A carriage return counts as blank, so that CR-LF lines need no care of their own.
inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Reads a decimal number at `begin`, independent of the locale; "nan" and "inf" too, and a leading
/// plus sign. Returns the end of the number, or null when there is none.
template <class T>
const char* parse_real(const char* begin, const char* end, T& value) {
  if (begin != end && *begin == '+') {
    ++begin;
    if (begin != end && *begin == '-') return nullptr;
  }
  const auto result = fast_float::from_chars(begin, end, value);
  return result.ec == std::errc() ? result.ptr : nullptr;
}

/// Reads a whole number at `begin`; also one written as a real, such as "12.0". Returns the end, or
/// null when there is none or it does not fit.
inline const char* parse_integer(const char* begin, const char* end, std::int64_t& value) {
  const char* digits = begin != end && *begin == '+' ? begin + 1 : begin;
  const auto result = std::from_chars(digits, end, value);
  const bool plain =
      result.ec == std::errc() &&
      (result.ptr == end || (*result.ptr != '.' && *result.ptr != 'e' && *result.ptr != 'E'));
  if (plain) return digits == begin || *digits != '-' ? result.ptr : nullptr;
  double real = 0.0;
  const char* stop = parse_real(begin, end, real);
  constexpr double kExact = 9007199254740992.0;  // 2^53
  if (stop == nullptr || !(real >= -kExact && real <= kExact)) return nullptr;
  value = static_cast<std::int64_t>(real);
  return static_cast<double>(value) == real ? stop : nullptr;
}

/// The whole of `text` as a number, or nothing.
inline std::optional<double> as_real(std::string_view text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  if (text.empty() || parse_real(text.data(), end, value) != end) return std::nullopt;
  return value;
}
inline std::optional<std::int64_t> as_integer(std::string_view text) {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  if (text.empty() || parse_integer(text.data(), end, value) != end) return std::nullopt;
  return value;
}

}  // namespace velum::formats
