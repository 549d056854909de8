// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Any bytes as what a scanner sends, in pieces: every telegram is refused as malformed, or is a
// scan that is written and read again as the same, or something else that can be named.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "lms511/scan.hpp"

namespace {

namespace lms = velum::lms511;

void require(bool good) {
  if (!good) std::abort();
}

void look_at(const lms::Telegram& telegram) {
  try {
    lms::Reader reader(telegram);
    if (reader.error()) return require(!lms::in_words(*reader.error()).empty());
    if (!lms::is_scan(reader)) return;
    const lms::Scan scan = lms::decode_scan(reader);
    for (const lms::Dialect dialect : {lms::Dialect::ascii, lms::Dialect::binary}) {
      const std::string payload = lms::encode_scan(scan, dialect);
      const std::string again = lms::encode_scan(lms::decode_scan({dialect, payload}), dialect);
      require(again == payload);
    }
  } catch (const lms::Malformed& malformed) {
    require(!malformed.where().empty());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::size_t piece = std::size_t{data[0]} * 8 + 1;  // how the bytes arrive
  const std::string_view stream(reinterpret_cast<const char*>(data) + 1, size - 1);  // NOLINT
  lms::Framer framer;
  for (std::size_t at = 0; at < stream.size(); at += piece) {
    framer.feed(stream.substr(at, piece));
    while (const auto telegram = framer.next()) look_at(*telegram);
    require(framer.pending() <= lms::kLongestTelegram + 16);
  }
  // The content of a telegram without its frame, which a random search rarely gets right.
  look_at({lms::Dialect::ascii, stream});
  look_at({lms::Dialect::binary, stream});
  return 0;
}
