// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>

#include "lms511/errors.hpp"
#include "lms511/frame.hpp"

namespace velum::lms511 {

/// Reads the parameters of one telegram in their order, in either dialect. Throws Malformed where
/// they do not fit. Numbers in CoLa A are hexadecimal, or decimal after a sign. The telegram's
/// bytes must outlive the reader.
class Reader {
 public:
  /// Throws Malformed when the payload does not begin with a kind and a name.
  explicit Reader(const Telegram& telegram);

  [[nodiscard]] Dialect dialect() const { return dialect_; }
  /// "sRA", "sSN", ..., "sFA".
  [[nodiscard]] std::string_view kind() const { return kind_; }
  /// The variable, method or event; empty for sFA.
  [[nodiscard]] std::string_view name() const { return name_; }
  /// The code of an sFA telegram, else nothing.
  [[nodiscard]] std::optional<ErrorCode> error() const { return error_; }

  std::uint8_t u8() { return static_cast<std::uint8_t>(number(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return number(4); }
  std::int16_t i16() { return static_cast<std::int16_t>(u16()); }
  std::int32_t i32() { return static_cast<std::int32_t>(u32()); }
  float f32();
  /// `count` characters without a length.
  std::string_view characters(std::size_t count);
  /// A text after its length of one byte or two; may hold blanks.
  std::string_view text8() { return characters(u8()); }
  std::string_view text16() { return characters(u16()); }
  /// Many numbers of two or one byte each.
  void numbers16(std::span<std::uint16_t> values);
  void numbers8(std::span<std::uint16_t> values);

  /// Is nothing but blanks left?
  [[nodiscard]] bool at_end() const;
  /// Bytes of the payload that are read.
  [[nodiscard]] std::size_t offset() const { return at_; }
  /// Bytes that are left, so that counts can be refused before memory is asked for.
  [[nodiscard]] std::size_t left() const { return payload_.size() - at_; }
  [[noreturn]] void fail(ErrorCode code, const std::string& message) const;

 private:
  std::uint32_t number(std::size_t bytes);
  std::uint32_t token(std::size_t bytes);
  std::uint32_t decimal(std::size_t bytes);
  void skip_blanks();
  void need(std::size_t bytes) const;

  Dialect dialect_;
  std::string_view payload_;
  std::string_view kind_;
  std::string_view name_;
  std::optional<ErrorCode> error_;
  std::size_t at_ = 0;
};

}  // namespace velum::lms511
