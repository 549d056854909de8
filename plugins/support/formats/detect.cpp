// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/detect.hpp"

#include <algorithm>
#include <cstdint>

#include "formats/lines.hpp"
#include "formats/records.hpp"

namespace velum::formats {
namespace {

struct Known {
  std::string_view start;
  std::string_view name;
};
/// Files that are something else, by how they begin.
constexpr Known kOthers[] = {{"ASTM-E57", "an E57 file"},
                             {"\x1f\x8b", "a gzip file"},
                             {"PK\x03\x04", "a zip file"},
                             {"\x89PNG", "a PNG image"},
                             {"%PDF", "a PDF document"},
                             {"\x7f"
                              "ELF",
                              "a program"},
                             {"{", "a JSON file"},
                             {"<?xml", "an XML file"},
                             {"ISO-10303-21;", "a STEP file"},
                             {"BZh", "a bzip2 file"},
                             {"\xFD"
                              "7zXZ",
                              "an xz file"}};

/// The first line that is neither blank nor a comment.
std::string_view first_line(std::string_view rest) {
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // a byte order mark
  while (!rest.empty()) {
    const std::string_view line = trimmed(take_line(rest));
    if (is_data(line, true)) return line;
  }
  return {};
}

/// A binary STL has no mark: its length must be that of the triangles it counts.
bool is_binary_stl(const Source& source) {
  if (source.size() < 84) return false;
  const std::size_t count = load<std::uint32_t>(source.bytes().data() + 80, false);
  return source.size() == 84 + 50 * count;
}

bool is_off(std::string_view line) {
  const std::string_view word = take_word(line);
  constexpr std::string_view kMarks[] = {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "4OFF", "nOFF"};
  return std::find(std::begin(kMarks), std::end(kMarks), word) != std::end(kMarks);
}

bool is_obj(std::string_view line) {
  const std::string_view word = take_word(line);
  constexpr std::string_view kWords[] = {"v", "vt", "vn", "vp", "f",      "g",
                                         "o", "s",  "l",  "p",  "mtllib", "usemtl"};
  if (std::find(std::begin(kWords), std::end(kWords), word) == std::end(kWords)) return false;
  return !trimmed(line).empty() || word == "g" || word == "o";
}

bool is_pcd(std::string_view line) {
  const std::string_view word = take_word(line);
  constexpr std::string_view kWords[] = {"VERSION", "FIELDS", "COLUMNS", "SIZE",  "TYPE",
                                         "COUNT",   "WIDTH",  "HEIGHT",  "POINTS"};
  return std::find(std::begin(kWords), std::end(kWords), word) != std::end(kWords);
}

bool is_text(std::string_view text) {
  constexpr std::size_t kLooked = 4096;
  return std::none_of(text.begin(),
                      text.begin() + static_cast<std::ptrdiff_t>(std::min(kLooked, text.size())),
                      [](char c) { return c >= '\0' && c < ' ' && c != '\n' && !is_blank(c); });
}

std::optional<Format> by_content(const Source& source) {
  const std::string_view text = source.text();
  const std::string_view line = first_line(text.substr(0, std::size_t{1} << 16U));
  if (trimmed(text.substr(0, text.find('\n'))) == "ply") return Format::ply;
  if (text.starts_with("glTF")) return Format::glb;
  if (text.starts_with("LASF")) return Format::las;
  if (text.starts_with("# vtk DataFile")) return Format::vtk;
  if (text.starts_with("# .PCD") || is_pcd(line)) return Format::pcd;
  if (is_binary_stl(source)) return Format::stl;
  if (text.starts_with("solid") && text.substr(0, 4096).find("facet") != std::string_view::npos)
    return Format::stl;
  if (is_off(line)) return Format::off;
  if (is_obj(line)) return Format::obj;
  return std::nullopt;
}

}  // namespace

std::string_view name_of(Format format) {
  constexpr std::string_view kNames[] = {"PCD", "PLY", "LAS", "VTK", "OFF",
                                         "OBJ", "STL", "GLB", "text"};
  return kNames[static_cast<std::size_t>(format)];
}

std::optional<Format> format_of_extension(std::string_view extension) {
  constexpr std::pair<std::string_view, Format> kExtensions[] = {
      {".pcd", Format::pcd},  {".ply", Format::ply},  {".las", Format::las},
      {".laz", Format::las},  {".vtk", Format::vtk},  {".off", Format::off},
      {".obj", Format::obj},  {".stl", Format::stl},  {".glb", Format::glb},
      {".xyz", Format::text}, {".txt", Format::text}, {".csv", Format::text},
      {".tsv", Format::text}, {".tab", Format::text}, {".asc", Format::text},
      {".pts", Format::text}, {".3d", Format::text},  {".dat", Format::text}};
  for (const auto& [known, format] : kExtensions)
    if (known == extension) return format;
  return std::nullopt;
}

Format detect(const Source& source) {
  if (const auto format = by_content(source)) return *format;
  for (const Known& other : kOthers)
    if (source.text().starts_with(other.start))
      throw Error(Fault::input,
                  "this is " + std::string(other.name) +
                      ", expected a point cloud or mesh (pcd, ply, las, vtk, xyz, txt, "
                      "csv, stl, obj, off, glb)")
          .at(source.name());
  const auto promised = format_of_extension(source.extension());
  // These formats always begin in the way that was looked for.
  if (promised && *promised != Format::text && *promised != Format::obj)
    throw Error(Fault::input, "the file does not begin as a " + std::string(name_of(*promised)) +
                                  " file does; found " + quote(source.text().substr(0, 40)))
        .at(source.name() + ": byte 0")
        .hint("name it .txt if it is plain text");
  if (!is_text(source.text()))
    throw Error(Fault::input, "the content is of no known format; found binary data")
        .at(source.name() + ": byte 0");
  return promised.value_or(Format::text);
}

}  // namespace velum::formats
