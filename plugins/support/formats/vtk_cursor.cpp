// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/vtk_cursor.hpp"

#include <fmt/format.h>

#include <limits>

namespace velum::formats {
namespace {

constexpr Index kValuesBetweenChecks = 1 << 20;

bool is_space(char c) {
  return is_blank(c) || c == '\n';
}

std::optional<FieldType> type_called(std::string_view name) {
  constexpr std::pair<std::string_view, FieldType> kTypes[] = {
      {"unsigned_char", FieldType::u8},  {"char", FieldType::i8},
      {"signed_char", FieldType::i8},    {"unsigned_short", FieldType::u16},
      {"short", FieldType::i16},         {"unsigned_int", FieldType::u32},
      {"int", FieldType::i32},           {"unsigned_long", FieldType::u64},
      {"long", FieldType::i64},          {"vtktypeint64", FieldType::i64},
      {"vtktypeuint64", FieldType::u64}, {"vtkidtype", FieldType::i32},
      {"float", FieldType::f32},         {"double", FieldType::f64}};
  for (const auto& [known, type] : kTypes)
    if (known == name) return type;
  return std::nullopt;
}

}  // namespace

void VtkCursor::skip_blanks() {
  const std::string_view text = source_.text();
  while (at_ < text.size() && is_space(text[at_])) ++at_;
}

bool VtkCursor::at_end() {
  skip_blanks();
  return at_ == source_.size();
}

std::string_view VtkCursor::line() {
  std::string_view left = rest();
  const std::string_view taken = take_line(left);
  at_ = source_.size() - left.size();
  return trimmed(taken);
}

std::string_view VtkCursor::word() {
  skip_blanks();
  const std::string_view found = peek();
  at_ += found.size();
  return found;
}

std::string_view VtkCursor::peek() const {
  std::string_view left = rest();
  while (!left.empty() && is_space(left.front())) left.remove_prefix(1);
  std::size_t end = 0;
  while (end < left.size() && !is_space(left[end])) ++end;
  return left.substr(0, end);
}

std::string_view VtkCursor::peek_on_line() const {
  std::string_view left = rest();
  left = left.substr(0, left.find('\n'));
  return take_word(left);
}

Index VtkCursor::count(Index most) {
  const std::string_view found = word();
  const auto value = as_integer(found);
  if (!value || *value < 0 || *value > most)
    throw bad(fmt::format("found {}, expected a count from 0 to {}", quote(found), most));
  return *value;
}

FieldType VtkCursor::type() {
  const std::string_view found = word();
  const auto type = type_called(lower(found));
  if (!type) throw bad("found " + quote(found) + ", expected a type such as float, double or int");
  return *type;
}

VtkArray VtkCursor::array(FieldType type, Index count, Context& context) {
  VtkArray array{type, count, nullptr};
  const auto values = static_cast<std::size_t>(count);
  const std::size_t bytes = values * size_of(type);
  if (binary_) {
    line();
    if (bytes > source_.size() - at_)
      throw source_.bad_byte(at_, fmt::format("{} bytes follow, expected {} ({} values of type {})",
                                              source_.size() - at_, bytes, count, name_of(type)));
    array.data = source_.bytes().data() + at_;
    at_ += bytes;
    return array;
  }
  // A value takes a character and a blank.
  if (values > (source_.size() - at_ + 1) / 2)
    throw bad(fmt::format("{} values do not fit into the {} characters that follow", count,
                          source_.size() - at_));
  std::byte* to = buffers_.emplace_back(bytes).data.get();
  array.data = to;
  const char* end = source_.text().data() + source_.size();
  for (Index i = 0; i < count; ++i, to += size_of(type)) {
    if (i % kValuesBetweenChecks == 0) context.check();
    skip_blanks();
    const char* begin = source_.text().data() + at_;
    const char* stop = parse_value(begin, end, type, to);
    if (stop == nullptr || (stop != end && !is_space(*stop)))
      throw bad(fmt::format("found {}, expected value {} of {} of type {}", quote(peek()), i + 1,
                            count, name_of(type)));
    at_ += static_cast<std::size_t>(stop - begin);
  }
  return array;
}

}  // namespace velum::formats
