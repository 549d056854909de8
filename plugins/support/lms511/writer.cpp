// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/writer.hpp"

#include <array>
#include <bit>
#include <charconv>

namespace velum::lms511 {

Writer::Writer(Dialect dialect, std::string_view kind, std::string_view name) : dialect_(dialect) {
  payload_.append(kind).append(" ").append(name);
}

Writer& Writer::f32(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  if (dialect_ == Dialect::binary) return u32(bits);
  separate();
  for (int shift = 28; shift >= 0; shift -= 4)
    payload_ += "0123456789ABCDEF"[bits >> static_cast<unsigned>(shift) & 0xfU];
  return *this;
}

Writer& Writer::characters(std::string_view text) {
  separate();
  payload_ += text;
  return *this;
}

Writer& Writer::text8(std::string_view text) {
  u8(static_cast<std::uint8_t>(text.size()));
  return text.empty() ? *this : characters(text);
}

Writer& Writer::text16(std::string_view text) {
  u16(static_cast<std::uint16_t>(text.size()));
  return text.empty() ? *this : characters(text);
}

Writer& Writer::numbers16(std::span<const std::uint16_t> values) {
  for (const std::uint16_t value : values) u16(value);
  return *this;
}

Writer& Writer::numbers8(std::span<const std::uint16_t> values) {
  for (const std::uint16_t value : values) u8(static_cast<std::uint8_t>(value));
  return *this;
}

Writer& Writer::no_parameters() {
  if (dialect_ == Dialect::binary) separate();
  return *this;
}

Writer& Writer::number(std::uint32_t value, int bytes) {
  separate();
  if (dialect_ == Dialect::ascii) {
    digits(value);
    return *this;
  }
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
    payload_ += static_cast<char>(value >> static_cast<unsigned>(shift) & 0xffU);
  return *this;
}

void Writer::separate() {
  if (dialect_ == Dialect::ascii || !separated_) payload_ += ' ';
  separated_ = true;
}

void Writer::digits(std::uint32_t value) {
  constexpr int kDigits = 8;
  std::array<char, kDigits> text{};
  std::size_t at = kDigits;
  do {
    text.at(--at) = "0123456789ABCDEF"[value & 0xfU];
    value >>= 4U;
  } while (value != 0);
  payload_.append(text.data() + at, kDigits - at);
}

std::string error_frame(Dialect dialect, ErrorCode code) {
  const auto number = static_cast<std::uint16_t>(code);
  if (dialect == Dialect::binary) {
    const std::array<char, 5> payload = {'s', 'F', 'A', static_cast<char>(number >> 8U),
                                         static_cast<char>(number & 0xffU)};
    return framed(dialect, {payload.data(), payload.size()});
  }
  std::array<char, 4> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number, 16).ptr;
  std::string payload = "sFA ";
  for (const char* c = text.data(); c != end; ++c)
    payload += *c >= 'a' ? static_cast<char>(*c - 'a' + 'A') : *c;
  return framed(dialect, payload);
}

}  // namespace velum::lms511
