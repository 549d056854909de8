// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "graph/utf8.hpp"

#include <fmt/format.h>

namespace velum::graph::toml {
namespace {

// Bytes of the sequence that begins with `lead`; 0 when none does.
std::size_t sequence_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) return 2;
  if (lead >= 0xE0 && lead <= 0xEF) return 3;
  if (lead >= 0xF0 && lead <= 0xF4) return 4;
  return 0;
}

}  // namespace

void Utf8Cursor::decode() {
  if (at_end()) return;
  const auto lead = static_cast<unsigned char>(text_[offset_]);
  length_ = sequence_length(lead);
  bool good = length_ != 0 && offset_ + length_ <= text_.size();
  char32_t code = length_ <= 1 ? lead : lead & (0x7FU >> length_);
  for (std::size_t i = 1; good && i < length_; ++i) {
    const auto next = static_cast<unsigned char>(text_[offset_ + i]);
    good = (next & 0xC0U) == 0x80U;
    code = (code << 6U) | (next & 0x3FU);
  }
  constexpr char32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  if (good)
    good = code >= kSmallest[length_] && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
  if (!good)
    throw SyntaxError({position_, {position_.line, position_.column + 1}},
                      fmt::format("byte 0x{:02X} is not UTF-8", lead),
                      "save the file in the encoding UTF-8");
  if (code == U'\r' && text_.substr(offset_, 2) == "\r\n") {
    length_ = 2;
    code = U'\n';
  }
  current_ = code;
}

char32_t Utf8Cursor::take() {
  const char32_t taken = current_;
  offset_ += length_;
  if (taken == U'\n') {
    position_ = {position_.line + 1, 1};
  } else {
    ++position_.column;
  }
  decode();
  return taken;
}

}  // namespace velum::graph::toml
