// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "formats/lines.hpp"

namespace velum::formats {
namespace {

constexpr std::size_t kMostProperties = 1000;

using Words = std::vector<std::string_view>;

std::optional<FieldType> type_of(std::string_view name) {
  constexpr std::pair<std::string_view, FieldType> kTypes[] = {
      {"char", FieldType::i8},    {"uchar", FieldType::u8},   {"short", FieldType::i16},
      {"ushort", FieldType::u16}, {"int", FieldType::i32},    {"uint", FieldType::u32},
      {"float", FieldType::f32},  {"double", FieldType::f64}, {"int8", FieldType::i8},
      {"uint8", FieldType::u8},   {"int16", FieldType::i16},  {"uint16", FieldType::u16},
      {"int32", FieldType::i32},  {"uint32", FieldType::u32}, {"float32", FieldType::f32},
      {"float64", FieldType::f64}};
  for (const auto& [known, type] : kTypes)
    if (known == name) return type;
  return std::nullopt;
}

class HeaderReader {
 public:
  explicit HeaderReader(const Source& source) : source_(source) {}

  PlyHeader read() {
    std::string_view rest = source_.text();
    const std::string_view first = take_line(rest);
    if (trimmed(first) != "ply")
      throw source_.bad_line(first, "found " + quote(trimmed(first)) + ", expected 'ply'");
    while (!rest.empty()) {
      const std::string_view line = take_line(rest);
      if (trimmed(line) == "end_header") {
        header_.body = source_.size() - rest.size();
        if (!formatted_) throw source_.bad_line(line, "the PLY header has no format");
        return std::move(header_);
      }
      read_line(line);
    }
    throw Error(Fault::input, "the PLY header has no end_header").at(source_.name());
  }

 private:
  void read_line(std::string_view line) {
    const Words words = words_of(line);
    if (words.empty() || words[0] == "obj_info") return;
    if (words[0] == "comment") {
      read_sensor_line(trimmed(line).substr(7), header_.sensors);
    } else if (words[0] == "format") {
      read_format(line, words);
    } else if (words[0] == "element") {
      read_element(line, words);
    } else if (words[0] == "property") {
      read_property(line, words);
    } else {
      throw source_.bad_line(line, "found " + quote(words[0]) +
                                       ", expected format, comment, obj_info, element, property or "
                                       "end_header");
    }
  }

  void read_format(std::string_view line, const Words& words) {
    const std::string_view name = words.size() == 3 && words[2] == "1.0" ? words[1] : "";
    if (name == "ascii")
      header_.format = PlyHeader::Format::ascii;
    else if (name == "binary_little_endian")
      header_.format = PlyHeader::Format::little;
    else if (name == "binary_big_endian")
      header_.format = PlyHeader::Format::big;
    else
      throw source_.bad_line(line,
                             "found " + quote(trimmed(line)) +
                                 ", expected 'format ascii 1.0', 'format "
                                 "binary_little_endian 1.0' or 'format binary_big_endian 1.0'");
    if (formatted_) throw source_.bad_line(line, "a second format");
    formatted_ = true;
  }

  void read_element(std::string_view line, const Words& words) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
    const auto count = words.size() == 3 ? as_integer(words[2]) : std::nullopt;
    if (!count || *count < 0 || *count > kMost)
      throw source_.bad_line(line,
                             fmt::format("found {}, expected 'element NAME COUNT' with a count "
                                         "from 0 to {}",
                                         quote(trimmed(line)), kMost));
    for (const PlyElement& element : header_.elements)
      if (element.name == words[1])
        throw source_.bad_line(line, "a second element " + quote(words[1]));
    if (header_.elements.size() >= kMostProperties)
      throw source_.bad_line(line, "too many elements");
    header_.elements.push_back({std::string(words[1]), *count, {}});
  }

  void read_property(std::string_view line, const Words& words) {
    if (header_.elements.empty()) throw source_.bad_line(line, "a property before any element");
    auto& properties = header_.elements.back().properties;
    PlyProperty property;
    property.list = words.size() == 5 && words[1] == "list";
    const auto type = property.list       ? type_of(words[3])
                      : words.size() == 3 ? type_of(words[1])
                                          : std::nullopt;
    const auto count_type = property.list ? type_of(words[2]) : FieldType::u8;
    if (!type || !count_type || is_real(*count_type))
      throw source_.bad_line(line,
                             "found " + quote(trimmed(line)) +
                                 ", expected 'property TYPE NAME' or 'property list TYPE TYPE "
                                 "NAME' with a type of PLY");
    property.type = *type;
    property.count_type = *count_type;
    property.name = std::string(words.back());
    for (const PlyProperty& other : properties)
      if (other.name == property.name)
        throw source_.bad_line(line, "a second property " + quote(property.name));
    if (properties.size() >= kMostProperties) throw source_.bad_line(line, "too many properties");
    properties.push_back(std::move(property));
  }

  const Source& source_;
  PlyHeader header_;
  bool formatted_ = false;
};

}  // namespace

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& property) { return property.list; });
}

std::size_t PlyElement::least_bytes() const {
  std::size_t bytes = 0;
  for (const PlyProperty& property : properties)
    bytes += size_of(property.list ? property.count_type : property.type);
  return bytes;
}

PlyHeader read_ply_header(const Source& source) {
  return HeaderReader(source).read();
}

}  // namespace velum::formats
