// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lms511/errors.hpp"
#include "lms511/frame.hpp"

namespace velum::lms511 {

/// Builds the payload of one telegram, request or answer, in either dialect:
///     Writer(dialect, "sWN", "LMPoutputRange").u16(1).u32(1667).i32(-50000).i32(1850000)
class Writer {
 public:
  /// `kind` is "sRN", "sAN", ...; `name` the variable, method or event.
  Writer(Dialect dialect, std::string_view kind, std::string_view name);

  Writer& u8(std::uint8_t value) { return number(value, 1); }
  Writer& u16(std::uint16_t value) { return number(value, 2); }
  Writer& u32(std::uint32_t value) { return number(value, 4); }
  Writer& i16(std::int16_t value) { return u16(static_cast<std::uint16_t>(value)); }
  Writer& i32(std::int32_t value) { return u32(static_cast<std::uint32_t>(value)); }
  /// Eight digits in CoLa A.
  Writer& f32(float value);
  /// Characters without a length, such as a channel's name.
  Writer& characters(std::string_view text);
  /// A text after its length: one byte (name and comment in scans) or two (answers to reads).
  Writer& text8(std::string_view text);
  Writer& text16(std::string_view text);
  /// Many numbers of two or one byte each.
  Writer& numbers16(std::span<const std::uint16_t> values);
  Writer& numbers8(std::span<const std::uint16_t> values);
  /// The blank that CoLa B answers carry behind their name even without parameters.
  Writer& no_parameters();

  [[nodiscard]] Dialect dialect() const { return dialect_; }
  [[nodiscard]] const std::string& payload() const { return payload_; }
  /// The payload with its marks.
  [[nodiscard]] std::string frame() const { return framed(dialect_, payload_); }

 private:
  Writer& number(std::uint32_t value, int bytes);
  void separate();
  void digits(std::uint32_t value);

  Dialect dialect_;
  std::string payload_;
  bool separated_ = false;  ///< CoLa B: the one blank before the parameters is there
};

/// The frame of "sFA code"; in CoLa B without a blank.
[[nodiscard]] std::string error_frame(Dialect dialect, ErrorCode code);

}  // namespace velum::lms511
