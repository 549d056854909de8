// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "formats/out_fields.hpp"
#include "formats/ply.hpp"

namespace velum::formats {
namespace {

std::string_view type_name(FieldType type) {
  switch (type) {
    case FieldType::u8:
      return "uchar";
    case FieldType::i32:
      return "int";
    case FieldType::f32:
      return "float";
    default:
      return "double";
  }
}

std::string header_of(const Cloud& cloud, const OutFields& fields, bool ascii, double unit,
                      std::optional<Index> faces) {
  std::string header = fmt::format("ply\nformat {} 1.0\ncomment written by Velum\n",
                                   ascii ? "ascii" : "binary_little_endian");
  for (const Sensor& sensor : cloud.sensors())
    header += "comment " + sensor_line(sensor, unit) + "\n";
  header += fmt::format("element vertex {}\n", cloud.size());
  for (const char* axis : {"x", "y", "z"})
    header += fmt::format("property {} {}\n", type_name(fields.front().type), axis);
  for (std::size_t i = 1; i < fields.size(); ++i)
    header += fmt::format("property {} {}\n", type_name(fields[i].type), fields[i].name);
  if (faces)
    header += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", *faces);
  return header + "end_header\n";
}

void write_points(AtomicFile& file, const Cloud& cloud, const OutFields& fields, bool ascii,
                  Context& context) {
  if (ascii)
    write_lines(file, fields, cloud.size(), ' ', context);
  else
    write_rows(file, fields, cloud.size(), false, context);
}

OutFields fields_of(const Cloud& cloud, double unit) {
  OutStyle style;
  style.unit = unit;
  return out_fields(cloud, style);
}

std::string binary_faces(const ConstTriangles& triangles, Index begin, Index end) {
  constexpr std::size_t kCorners = 3 * sizeof(std::int32_t);
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(end - begin) * (1 + kCorners));
  for (Index i = begin; i < end; ++i) {
    char corners[kCorners];
    std::memcpy(corners, triangles.data() + 3 * i, kCorners);
    bytes += '\3';
    bytes.append(corners, kCorners);
  }
  return bytes;
}

std::string text_faces(const ConstTriangles& triangles, Index begin, Index end) {
  std::string text;
  for (Index i = begin; i < end; ++i) {
    text += '3';
    for (Index c = 0; c < 3; ++c) {
      text += ' ';
      append_number(text, std::int64_t{triangles(c, i)});
    }
    text += '\n';
  }
  return text;
}

}  // namespace

void write_ply(AtomicFile& file, const Cloud& cloud, bool ascii, double unit, Context& context) {
  const OutFields fields = fields_of(cloud, unit);
  file.write(header_of(cloud, fields, ascii, unit, std::nullopt));
  write_points(file, cloud, fields, ascii, context);
}

void write_ply(AtomicFile& file, const Mesh& mesh, bool ascii, double unit, Context& context) {
  const OutFields fields = fields_of(mesh.vertices(), unit);
  file.write(header_of(mesh.vertices(), fields, ascii, unit, mesh.size()));
  write_points(file, mesh.vertices(), fields, ascii, context);
  const ConstTriangles triangles = mesh.triangles();
  write_pieces(file, mesh.size(), 65536, context, [&](Index begin, Index end) {
    return ascii ? text_faces(triangles, begin, end) : binary_faces(triangles, begin, end);
  });
}

}  // namespace velum::formats
