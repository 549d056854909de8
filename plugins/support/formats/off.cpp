// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/off.hpp"

#include <fmt/format.h>

#include <limits>

#include "formats/out_fields.hpp"
#include "formats/polygons.hpp"
#include "formats/rows.hpp"

namespace velum::formats {
namespace {

struct OffHeader {
  std::vector<std::string> names;  ///< of a vertex's values
  bool alpha = false;              ///< colours may have a fourth value
  Index vertices = 0;
  Index faces = 0;
  std::size_t body = 0;
};

std::string_view next_line(std::string_view& rest) {
  while (!rest.empty()) {
    std::string_view line = take_line(rest);
    line = trimmed(line.substr(0, line.find('#')));
    if (!line.empty()) return line;
  }
  return {};
}

OffHeader read_header(const Source& source) {
  OffHeader header;
  std::string_view rest = source.text();
  std::string_view line = next_line(rest);
  const std::string_view mark = take_word(line);
  header.names = {"x", "y", "z"};
  if (mark == "NOFF")
    header.names.insert(header.names.end(), {"nx", "ny", "nz"});
  else if (mark == "COFF")
    header.names.insert(header.names.end(), {"red", "green", "blue"});
  else if (mark != "OFF")
    throw source.bad_line(std::size_t{0}, "found " + quote(mark) + ", expected OFF, COFF or NOFF");
  header.alpha = mark == "COFF";
  line = trimmed(line);
  if (line.starts_with("BINARY")) throw source.bad_line(line, "binary OFF is not read");
  if (line.empty()) line = next_line(rest);
  const std::vector<std::string_view> counts = words_of(line);
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  std::int64_t values[3] = {};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = counts.size() == 3 ? as_integer(counts[i]) : std::nullopt;
    if (!value || *value < 0 || *value > kMost)
      throw source.bad_line(
          line.empty() ? source.text() : line,
          "found " + quote(line) + ", expected three counts: vertices, faces, edges");
    values[i] = *value;
  }
  header.vertices = values[0];
  header.faces = values[1];
  header.body = source.size() - rest.size();
  return header;
}

Records read_vertices(const Source& source, const OffHeader& header, const Lines& lines,
                      Buffer& rows, Context& context) {
  RowLayout layout;
  for (std::size_t i = 0; i < header.names.size(); ++i) layout.add(FieldType::f64);
  std::size_t values = header.names.size();
  if (header.alpha && header.vertices > 0) {
    std::string_view first = lines.blocks.front().text;
    values = words_of(next_line(first)).size();
    if (values == header.names.size() + 1) layout.add(FieldType::f64);
  }
  rows = parse_rows(source, lines, 0, header.vertices, layout, context);
  Records records;
  records.count = header.vertices;
  for (std::size_t i = 0; i < header.names.size(); ++i)
    records.fields.push_back(
        {header.names[i], FieldType::f64, 1, rows.data.get() + i * sizeof(double), layout.stride});
  return records;
}

/// A count, that many vertices, and perhaps a colour, which is passed over.
void read_face(const Source& source, std::string_view line, Index vertices,
               std::vector<std::int64_t>& polygon, Polygons& polygons) {
  std::string_view rest = line.substr(0, line.find('#'));
  const std::string_view word = take_word(rest);
  const auto count = as_integer(word);
  if (!count || *count < 0 || *count > static_cast<std::int64_t>(rest.size() / 2))
    throw source.bad_line(line, "a face of " + quote(word) + " corners");
  polygon.clear();
  for (std::int64_t i = 0; i < *count; ++i) {
    const auto corner = as_integer(take_word(rest));
    if (!corner)
      throw source.bad_line(line, fmt::format("a face with fewer than {} corners", *count));
    polygon.push_back(*corner);
  }
  std::size_t colours = 0;
  for (std::string_view more = take_word(rest); !more.empty(); more = take_word(rest))
    if (!as_real(more) || ++colours > 4)
      throw source.bad_line(line, "found " + quote(more) + " after the face's corners");
  if (!polygons.add(polygon, vertices))
    throw source.bad_line(line,
                          fmt::format("a face with a vertex out of range; there are {}", vertices));
}

}  // namespace

Mesh read_off(const Source& source, const ReadOptions& options, Context& context) {
  const OffHeader header = read_header(source);
  const Lines lines = split_lines(source.text().substr(header.body), true, context);
  if (lines.count != header.vertices + header.faces)
    throw source.bad_line(source.size(),
                          fmt::format("found {} lines of data, expected {} vertices and "
                                      "{} faces",
                                      lines.count, header.vertices, header.faces));
  Buffer rows(0);
  const Records records = read_vertices(source, header, lines, rows, context);
  Polygons polygons;
  std::vector<std::int64_t> polygon;
  for (const Lines::Block& block : lines.blocks) {
    context.check();
    each_line(lines, block, [&](std::string_view line, Index number) {
      if (number >= header.vertices) read_face(source, line, header.vertices, polygon, polygons);
    });
  }
  return make_mesh(source, assemble(source, records, options, NotFinite::refuse, context), polygons,
                   options, context);
}

void write_off(AtomicFile& file, const Mesh& mesh, double unit, Context& context) {
  file.write(fmt::format("OFF\n{} {} 0\n", mesh.vertices().size(), mesh.size()));
  write_lines(file, {out_positions(mesh.vertices(), unit)}, mesh.vertices().size(), ' ', context);
  write_pieces(file, mesh.size(), 65536, context, [&](Index begin, Index end) {
    std::string text;
    for (Index i = begin; i < end; ++i) {
      text += '3';
      for (Index c = 0; c < 3; ++c)
        append_number(text += ' ', std::int64_t{mesh.triangles()(c, i)});
      text += '\n';
    }
    return text;
  });
}

}  // namespace velum::formats
