// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <deque>

#include "formats/lines.hpp"
#include "formats/records.hpp"
#include "formats/rows.hpp"
#include "formats/source.hpp"

namespace velum::formats {

/// An array of a VTK file: in the file itself where it is binary.
struct VtkArray {
  FieldType type = FieldType::f32;
  Index count = 0;  ///< of all values
  const std::byte* data = nullptr;
};

/// Reads a legacy VTK file from word to word and array to array.
class VtkCursor {
 public:
  explicit VtkCursor(const Source& source) : source_(source) {}

  void set_binary(bool binary) { binary_ = binary; }
  [[nodiscard]] bool binary() const { return binary_; }
  [[nodiscard]] bool at_end();
  /// The rest of the current line.
  std::string_view line();
  /// The next word, on this line or a later one.
  std::string_view word();
  /// The next word without taking it.
  [[nodiscard]] std::string_view peek() const;
  /// The same if it stands on the current line, else nothing.
  [[nodiscard]] std::string_view peek_on_line() const;
  /// The words that are left on this line.
  std::vector<std::string_view> words_of_line() { return words_of(line()); }
  /// The next word as a count.
  Index count(Index most);
  FieldType type();
  /// `count` values, which begin on the next line in a binary file.
  VtkArray array(FieldType type, Index count, Context& context);

  [[nodiscard]] Error bad(const std::string& message) const {
    return source_.bad_line(at_, message);
  }

 private:
  void skip_blanks();
  [[nodiscard]] std::string_view rest() const { return source_.text().substr(at_); }

  const Source& source_;
  bool binary_ = false;
  std::size_t at_ = 0;
  std::deque<Buffer> buffers_;  // of arrays that were text
};

}  // namespace velum::formats
