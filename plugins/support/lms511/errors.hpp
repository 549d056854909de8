// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "velum/error.hpp"

namespace velum::lms511 {

/// What a device answers with sFA (listing 8014631).
enum class ErrorCode : std::uint16_t {
  none = 0x00,
  access_denied = 0x01,
  method_unknown = 0x02,
  variable_unknown = 0x03,
  out_of_range = 0x04,
  invalid_data = 0x05,
  unknown = 0x06,
  too_many_bytes = 0x07,
  too_few_parameters = 0x08,
  wrong_type = 0x09,
  write_denied = 0x0A,
  kind_unknown = 0x0B,
  command_unknown = 0x0C,
  busy = 0x0D,
  out_of_bounds = 0x0E,
  event_unknown = 0x0F,
  overflow = 0x10,
  invalid_character = 0x11,
  no_message = 0x12,
  no_answer = 0x13,
  internal = 0x14,
  hub_address = 0x15,
  hub_decoding = 0x16,
  hub_length = 0x17,
  hub_expired = 0x18,
  asynchronous_suppressed = 0x19,
  complex_arrays = 0x1A,
};

/// What a code means, in words: "the variable is unknown"; of a number that the listing does not
/// have, "a code that is not listed".
[[nodiscard]] std::string_view meaning(ErrorCode code);
/// "sFA 3 (the variable is unknown)".
[[nodiscard]] std::string in_words(ErrorCode code);

/// A telegram whose content does not fit its name. Fault::input, at the byte of the payload.
class Malformed : public Error {
 public:
  Malformed(ErrorCode code, const std::string& message, std::size_t offset);
  /// What a device answers to a request with this fault.
  [[nodiscard]] ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace velum::lms511
