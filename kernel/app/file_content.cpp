// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "file_content.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

namespace velum::app {
namespace {

std::string_view first_line(std::string_view text) {
  return text.substr(0, text.find_first_of("\r\n"));
}

/// The first word of the first line that is neither blank nor a comment.
std::string_view first_word(std::string_view text) {
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    line.remove_prefix(std::min(line.size(), line.find_first_not_of(" \t\r")));
    if (!line.empty() && !line.starts_with('#') && !line.starts_with("//"))
      return line.substr(0, line.find_first_of(" \t\r,;"));
  }
  return {};
}

template <std::size_t N>
bool is_one_of(std::string_view word, const std::string_view (&list)[N]) {
  return std::find(std::begin(list), std::end(list), word) != std::end(list);
}

FileKind ply_kind(std::string_view text) {
  const std::size_t at = text.find("element face ");
  const bool faces = at != std::string_view::npos && text.substr(at, 14) != "element face 0";
  return faces ? FileKind::mesh : FileKind::cloud;
}

/// A binary STL has no mark: its length must be that of the triangles it counts.
bool is_binary_stl(std::string_view text, std::uintmax_t size) {
  constexpr std::size_t kHeader = 84;
  constexpr std::uintmax_t kTriangle = 50;
  if (text.size() < kHeader) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, text.data() + kHeader - sizeof(count), sizeof(count));
  return size == kHeader + kTriangle * count;
}

/// Lines of 80 columns, the 73rd of which tells the section; the first is S.
bool is_iges(std::string_view text) {
  constexpr std::size_t kSection = 72;
  const std::string_view line = first_line(text);
  return line.size() == kSection + 8 && line[kSection] == 'S' && line.ends_with(" 1");
}

}  // namespace

std::optional<FileKind> kind_by_content(std::string_view text, std::uintmax_t size) {
  constexpr std::string_view kPcd[] = {"VERSION", "FIELDS", "COLUMNS"};
  constexpr std::string_view kOff[] = {"OFF", "COFF", "NOFF", "CNOFF"};
  constexpr std::string_view kObj[] = {"v", "vn", "vt", "mtllib", "usemtl", "o", "g"};
  const std::string_view line = first_line(text);
  const std::string_view word = first_word(text);
  if (text.starts_with("VELUMREC")) return FileKind::recording;
  if (line == "ply" || line.starts_with("ply ")) return ply_kind(text);
  if (line.starts_with("# vtk DataFile"))
    return text.find("POLYGONS") != std::string_view::npos ? FileKind::mesh : FileKind::cloud;
  if (text.starts_with("LASF") || line.starts_with("# .PCD") || is_one_of(word, kPcd))
    return FileKind::cloud;
  if (text.starts_with("ISO-10303-21;") || is_iges(text)) return FileKind::surface;
  if (text.starts_with("glTF") || is_binary_stl(text, size)) return FileKind::mesh;
  if (text.starts_with("solid") && text.find("facet") != std::string_view::npos)
    return FileKind::mesh;
  if (is_one_of(word, kOff) || is_one_of(word, kObj)) return FileKind::mesh;
  return std::nullopt;
}

bool is_matrix(std::string_view text) {
  std::istringstream lines{std::string(text)};
  std::vector<std::string> numbers;
  for (std::string line; std::getline(lines, line) && numbers.size() < 17;) {
    std::istringstream words(line.substr(0, line.find('#')));
    for (std::string word; words >> word && numbers.size() < 17;) numbers.push_back(word);
  }
  if (numbers.size() != 16) return false;
  for (std::size_t i = 12; i < 16; ++i) {
    double number = -1.0;
    std::from_chars(numbers[i].data(), numbers[i].data() + numbers[i].size(), number);
    if (number != (i == 15 ? 1.0 : 0.0)) return false;
  }
  return true;
}

bool begins_with_numbers(std::string_view text) {
  const std::string_view word = first_word(text);
  const std::size_t sign = word.starts_with('-') || word.starts_with('+') ? 1 : 0;
  double number = 0.0;
  const char* end = word.data() + word.size();
  return std::from_chars(word.data() + std::min(sign, word.size()), end, number).ptr == end &&
         word.size() > sign;
}

}  // namespace velum::app
