// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>

namespace velum::lms511 {
namespace {

constexpr std::size_t kKind = 3;
constexpr std::uint8_t kNoDigit = 0xff;

constexpr std::array<std::uint8_t, 256> kDigits = [] {
  std::array<std::uint8_t, 256> digits{};
  digits.fill(kNoDigit);
  for (unsigned i = 0; i < 10; ++i) digits[std::size_t{'0'} + i] = static_cast<std::uint8_t>(i);
  for (unsigned i = 0; i < 6; ++i) {
    digits[std::size_t{'A'} + i] = static_cast<std::uint8_t>(10 + i);
    digits[std::size_t{'a'} + i] = static_cast<std::uint8_t>(10 + i);
  }
  return digits;
}();

bool is_word(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
  });
}

}  // namespace

Reader::Reader(const Telegram& telegram) : dialect_(telegram.dialect), payload_(telegram.payload) {
  kind_ = payload_.substr(0, kKind);
  if (kind_.size() < kKind || kind_.front() != 's' || !is_word(kind_))
    fail(ErrorCode::kind_unknown, "no kind of command, expected one such as sRA");
  at_ = kKind;
  if (kind_ == "sFA") {
    error_ = static_cast<ErrorCode>(u16());
    return;
  }
  if (left() == 0 || payload_[at_] != ' ')
    fail(ErrorCode::kind_unknown, "no blank behind the kind of command");
  ++at_;
  name_ = payload_.substr(at_, std::min(payload_.find(' ', at_), payload_.size()) - at_);
  if (!is_word(name_)) fail(ErrorCode::command_unknown, "no name behind the kind of command");
  at_ += name_.size();
  if (dialect_ == Dialect::binary && left() > 0) ++at_;
}

void Reader::fail(ErrorCode code, const std::string& message) const {
  const std::string name = name_.empty() ? "" : fmt::format("{}: ", name_);
  throw Malformed(code, name + message, at_);
}

void Reader::need(std::size_t bytes) const {
  if (left() < bytes)
    fail(ErrorCode::too_few_parameters,
         fmt::format("the telegram ends {} bytes early", bytes - left()));
}

std::uint32_t Reader::number(std::size_t bytes) {
  if (dialect_ == Dialect::ascii) return token(bytes);
  need(bytes);
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i)
    value = value << 8U | static_cast<std::uint8_t>(payload_[at_ + i]);
  at_ += bytes;
  return value;
}

void Reader::skip_blanks() {
  while (at_ < payload_.size() && payload_[at_] == ' ') ++at_;
}

std::uint32_t Reader::token(std::size_t bytes) {
  skip_blanks();
  need(1);
  if (payload_[at_] == '+' || payload_[at_] == '-') return decimal(bytes);
  const std::size_t begin = at_;
  std::uint64_t value = 0;
  while (at_ < payload_.size()) {
    const std::uint8_t digit = kDigits[static_cast<std::uint8_t>(payload_[at_])];
    if (digit == kNoDigit) break;
    value = value << 4U | digit;
    if (value >> (8 * bytes) != 0)
      fail(ErrorCode::overflow, fmt::format("a number does not fit into {} bytes", bytes));
    ++at_;
  }
  if (at_ == begin || (at_ < payload_.size() && payload_[at_] != ' '))
    fail(ErrorCode::invalid_character, "no hexadecimal number");
  return static_cast<std::uint32_t>(value);
}

// Signed numbers are cut to the two's complement of their width.
std::uint32_t Reader::decimal(std::size_t bytes) {
  const char* begin = payload_.data() + at_ + (payload_[at_] == '+' ? 1 : 0);
  const char* end = payload_.data() + payload_.size();
  std::int64_t value = 0;
  const auto result = std::from_chars(begin, end, value);
  if (result.ec != std::errc() || (result.ptr != end && *result.ptr != ' '))
    fail(ErrorCode::invalid_character, "no decimal number behind its sign");
  const std::int64_t full = std::int64_t{1} << (8 * bytes);
  if (value >= full || value < -full / 2)
    fail(ErrorCode::overflow, fmt::format("a number does not fit into {} bytes", bytes));
  at_ = static_cast<std::size_t>(result.ptr - payload_.data());
  return static_cast<std::uint32_t>(value & (full - 1));
}

float Reader::f32() {
  return std::bit_cast<float>(u32());
}

std::string_view Reader::characters(std::size_t count) {
  if (count == 0) return {};
  if (dialect_ == Dialect::ascii) {
    need(1);
    if (payload_[at_] != ' ') fail(ErrorCode::invalid_data, "no blank before a text");
    ++at_;
  }
  need(count);
  const std::string_view text = payload_.substr(at_, count);
  at_ += count;
  if (dialect_ == Dialect::ascii && left() > 0 && payload_[at_] != ' ')
    fail(ErrorCode::invalid_data, "a text is longer than its length says");
  return text;
}

void Reader::numbers16(std::span<std::uint16_t> values) {
  if (dialect_ == Dialect::ascii) {
    for (std::uint16_t& value : values) value = static_cast<std::uint16_t>(token(2));
    return;
  }
  need(2 * values.size());
  const char* from = payload_.data() + at_;
  for (std::uint16_t& value : values) {
    const auto high = static_cast<std::uint8_t>(from[0]);
    const auto low = static_cast<std::uint8_t>(from[1]);
    value = static_cast<std::uint16_t>(high << 8U | low);
    from += 2;
  }
  at_ += 2 * values.size();
}

void Reader::numbers8(std::span<std::uint16_t> values) {
  if (dialect_ == Dialect::ascii) {
    for (std::uint16_t& value : values) value = static_cast<std::uint16_t>(token(1));
    return;
  }
  need(values.size());
  for (std::uint16_t& value : values) value = static_cast<std::uint8_t>(payload_[at_++]);
}

bool Reader::at_end() const {
  if (dialect_ == Dialect::binary) return left() == 0;
  return payload_.find_first_not_of(' ', at_) == std::string_view::npos;
}

}  // namespace velum::lms511
