// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/frame.hpp"

#include <algorithm>
#include <cstring>

namespace velum::lms511 {
namespace {

constexpr char kStart = '\x02';
constexpr char kEnd = '\x03';
constexpr std::size_t kMarks = 4;          // of CoLa B
constexpr std::size_t kHead = kMarks + 4;  // marks and length
constexpr std::size_t kLeastPayload = 5;   // "sFA" and a code

std::uint8_t exclusive_or(std::string_view bytes) {
  std::uint64_t wide = 0;
  std::size_t at = 0;
  for (; at + sizeof(wide) <= bytes.size(); at += sizeof(wide)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof(word));
    wide ^= word;
  }
  wide ^= wide >> 32U;
  wide ^= wide >> 16U;
  wide ^= wide >> 8U;
  auto sum = static_cast<std::uint8_t>(wide & 0xffU);
  for (; at < bytes.size(); ++at)
    sum = static_cast<std::uint8_t>(sum ^ static_cast<std::uint8_t>(bytes[at]));
  return sum;
}

std::size_t length_at(std::string_view head) {
  std::size_t length = 0;
  for (std::size_t i = kMarks; i < kHead; ++i)
    length = length << 8U | static_cast<std::uint8_t>(head[i]);
  return length;
}

}  // namespace

std::string_view name_of(Dialect dialect) {
  return dialect == Dialect::ascii ? "CoLa A" : "CoLa B";
}

std::string framed(Dialect dialect, std::string_view payload) {
  std::string frame;
  frame.reserve(payload.size() + kHead + 1);
  if (dialect == Dialect::ascii) {
    frame += kStart;
    frame += payload;
    frame += kEnd;
    return frame;
  }
  frame.append(kMarks, kStart);
  for (int shift = 24; shift >= 0; shift -= 8)
    frame += static_cast<char>(payload.size() >> static_cast<unsigned>(shift) & 0xffU);
  frame += payload;
  frame += static_cast<char>(exclusive_or(payload));
  return frame;
}

void Framer::feed(std::string_view bytes) {
  buffer_.erase(0, begin_);
  begin_ = 0;
  buffer_ += bytes;
}

std::optional<Telegram> Framer::next() {
  while (to_mark()) {
    const Cut found = cut(std::string_view(buffer_).substr(begin_));
    if (found.found == Found::part) return std::nullopt;
    scanned_ = 0;
    if (found.found == Found::whole) {
      begin_ += found.size;
      ++counts_.telegrams;
      return found.telegram;
    }
    ++begin_;
    ++counts_.skipped_bytes;
  }
  return std::nullopt;
}

// Skips what comes before the next mark; false when there is none.
bool Framer::to_mark() {
  const std::size_t mark = std::min(buffer_.find(kStart, begin_), buffer_.size());
  if (mark != begin_) scanned_ = 0;
  counts_.skipped_bytes += mark - begin_;
  begin_ = mark;
  return begin_ < buffer_.size();
}

Framer::Cut Framer::cut(std::string_view rest) {
  if (dialect_) return *dialect_ == Dialect::ascii ? cut_ascii(rest) : cut_binary(rest);
  if (rest.size() < 2) return {.found = Found::part};
  return rest[1] == kStart ? cut_binary(rest) : cut_ascii(rest);
}

Framer::Cut Framer::cut_ascii(std::string_view rest) {
  if (rest.size() < 2) return {.found = Found::part};
  if (rest[1] != 's') return {};
  std::size_t at = std::max<std::size_t>(scanned_, 1);
  while (at < rest.size() && static_cast<std::uint8_t>(rest[at]) >= 0x20U) ++at;
  scanned_ = at;
  if (at > kLongestTelegram) {
    ++counts_.bad_lengths;
    return {};
  }
  if (at == rest.size()) return {.found = Found::part};
  if (rest[at] != kEnd || at <= kLeastPayload) return {};
  return {Found::whole, at + 1, {Dialect::ascii, rest.substr(1, at - 1)}};
}

Framer::Cut Framer::cut_binary(std::string_view rest) {
  const std::size_t marks = std::min(rest.size(), kMarks);
  if (rest.find_first_not_of(kStart) < marks) return {};
  if (rest.size() <= kHead) return {.found = Found::part};
  const std::size_t length = length_at(rest);
  if (length < kLeastPayload || length > kLongestTelegram || rest[kHead] != 's') {
    ++counts_.bad_lengths;
    return {};
  }
  if (rest.size() < kHead + length + 1) return {.found = Found::part};
  const std::string_view payload = rest.substr(kHead, length);
  if (exclusive_or(payload) != static_cast<std::uint8_t>(rest[kHead + length])) {
    ++counts_.bad_checksums;
    return {};
  }
  return {Found::whole, kHead + length + 1, {Dialect::binary, payload}};
}

}  // namespace velum::lms511
