// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "formats/out_fields.hpp"
#include "formats/vtk.hpp"

namespace velum::formats {
namespace {

std::string_view type_name(FieldType type) {
  switch (type) {
    case FieldType::u8:
      return "unsigned_char";
    case FieldType::i32:
      return "int";
    case FieldType::f32:
      return "float";
    default:
      return "double";
  }
}

class VtkWriter {
 public:
  VtkWriter(AtomicFile& file, bool ascii, Context& context)
      : file_(file), ascii_(ascii), context_(context) {}

  void begin(const Cloud& cloud, double unit) {
    const OutField positions = out_positions(cloud, unit);
    file_.write(
        fmt::format("# vtk DataFile Version 3.0\nwritten by Velum\n{}\nDATASET POLYDATA\n"
                    "POINTS {} {}\n",
                    ascii_ ? "ASCII" : "BINARY", cloud.size(), type_name(positions.type)));
    values({positions}, cloud.size());
  }

  /// Cells of `width` vertices each, vertex(i, c) of cell i.
  template <class Vertex>
  void cells(const char* kind, Index count, int width, const Vertex& vertex) {
    file_.write(fmt::format("{} {} {}\n", kind, count, count * (width + 1)));
    OutField field{"cell", FieldType::i32, width + 1, {}};
    field.fill = [&](Index begin, Index end, std::byte* to, std::size_t stride) {
      for (Index i = begin; i < end; ++i, to += stride) {
        std::int32_t cell[4] = {width};
        for (int c = 0; c < width; ++c) cell[c + 1] = vertex(i, c);
        std::memcpy(to, cell, field.bytes());
      }
    };
    values({field}, count);
  }

  /// Normals as such, everything else as arrays of a field.
  void data(const Cloud& cloud) {
    if (cloud.columns().empty()) return;
    file_.write(fmt::format("POINT_DATA {}\n", cloud.size()));
    std::vector<std::pair<std::string, OutFields>> arrays;
    for (const auto& [name, column] : cloud.columns()) {
      OutStyle style;
      style.positions = false;
      const Cloud one = Cloud(cloud.position_column()).with(name, column);
      OutFields fields = out_fields(one, style);
      std::string title = fields.size() == 1 ? fields.front().name : plain_name(name);
      if (name == column::kNormals) {
        file_.write(std::string_view("NORMALS normals float\n"));
        values(fields, cloud.size());
      } else {
        arrays.emplace_back(std::move(title), std::move(fields));
      }
    }
    if (arrays.empty()) return;
    file_.write(fmt::format("FIELD FieldData {}\n", arrays.size()));
    for (const auto& [title, fields] : arrays) {
      file_.write(fmt::format("{} {} {} {}\n", title, fields.size(), cloud.size(),
                              type_name(fields.front().type)));
      values(fields, cloud.size());
    }
  }

 private:
  static std::string plain_name(std::string name) {
    for (char& c : name)
      if (c <= ' ' || c > '~') c = '_';
    return name;
  }

  void values(const OutFields& fields, Index count) {
    if (ascii_) {
      write_lines(file_, fields, count, ' ', context_);
    } else {
      write_rows(file_, fields, count, true, context_);  // big-endian
      file_.write(std::string_view("\n"));
    }
  }

  AtomicFile& file_;
  bool ascii_;
  Context& context_;
};

}  // namespace

void write_vtk(AtomicFile& file, const Cloud& cloud, bool ascii, double unit, Context& context) {
  VtkWriter writer(file, ascii, context);
  writer.begin(cloud, unit);
  writer.cells("VERTICES", cloud.size(), 1,
               [](Index i, int) { return static_cast<std::int32_t>(i); });
  writer.data(cloud);
}

void write_vtk(AtomicFile& file, const Mesh& mesh, bool ascii, double unit, Context& context) {
  VtkWriter writer(file, ascii, context);
  writer.begin(mesh.vertices(), unit);
  const ConstTriangles triangles = mesh.triangles();
  writer.cells("POLYGONS", mesh.size(), 3, [&](Index i, int c) { return triangles(c, i); });
  writer.data(mesh.vertices());
}

}  // namespace velum::formats
