// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <limits>

#include "formats/polygons.hpp"
#include "formats/vtk.hpp"
#include "formats/vtk_cursor.hpp"

namespace velum::formats {
namespace {

constexpr Index kMostValues = std::numeric_limits<std::int32_t>::max();
constexpr Index kMostComponents = 1000;

/// Cells as VTK lists them: a count and that many vertices, or (from version 5) offsets and
/// vertices.
struct Cells {
  std::string kind;
  Index count = 0;
  VtkArray offsets;
  VtkArray vertices;
};

class VtkReader {
 public:
  VtkReader(const Source& source, Context& context)
      : source_(source), context_(context), cursor_(source) {}

  void read() {
    read_header();
    while (!cursor_.at_end()) read_section(cursor_.word());
    if (!points_) throw Error(Fault::input, "the VTK file has no POINTS").at(source_.name());
  }

  /// The points and all point data.
  Records records() {
    records_.count = points_->count / 3;
    records_.swapped = cursor_.binary();
    const std::size_t size = size_of(points_->type);
    for (std::size_t a = 0; a < 3; ++a)
      records_.fields.insert(records_.fields.begin() + static_cast<std::ptrdiff_t>(a),
                             {std::string(1, static_cast<char>('x' + a)), points_->type, 1,
                              points_->data + a * size, 3 * size});
    return std::move(records_);
  }

  Polygons polygons() {
    Polygons result;
    for (const Cells& cells : cells_) {
      if (cells.kind == "POLYGONS" || cells.kind == "TRIANGLE_STRIPS" || cells.kind == "CELLS")
        add_cells(cells, result);
    }
    return result;
  }

 private:
  void read_header() {
    if (!cursor_.line().starts_with("# vtk DataFile"))
      throw cursor_.bad("the file does not begin with '# vtk DataFile'");
    cursor_.line();  // a title
    const std::string kind = lower(cursor_.word());
    if (kind != "ascii" && kind != "binary")
      throw cursor_.bad("found " + quote(kind) + ", expected ASCII or BINARY");
    cursor_.set_binary(kind == "binary");
  }

  void read_section(std::string_view word) {
    if (word == "DATASET")
      read_dataset();
    else if (word == "DIMENSIONS")
      cursor_.line();
    else if (word == "POINTS")
      read_points();
    else if (word == "VERTICES" || word == "LINES" || word == "POLYGONS" ||
             word == "TRIANGLE_STRIPS" || word == "CELLS")
      read_cells(std::string(word));
    else if (word == "CELL_TYPES")
      types_ = cursor_.array(FieldType::i32, cursor_.count(kMostValues), context_);
    else if (word == "POINT_DATA")
      begin_data(true);
    else if (word == "CELL_DATA")
      begin_data(false);
    else if (word == "METADATA")
      while (!cursor_.line().empty()) continue;
    else
      read_attribute(word);
  }

  void read_dataset() {
    const std::string_view kind = cursor_.word();
    if (kind != "POLYDATA" && kind != "UNSTRUCTURED_GRID" && kind != "STRUCTURED_GRID")
      throw cursor_.bad("DATASET " + std::string(kind) +
                        " is not read, expected POLYDATA, UNSTRUCTURED_GRID or STRUCTURED_GRID");
  }

  void read_points() {
    if (points_) throw cursor_.bad("a second POINTS");
    const Index count = cursor_.count(kMostValues);
    const FieldType type = cursor_.type();
    points_ = cursor_.array(type, 3 * count, context_);
  }

  void read_cells(std::string kind) {
    Cells cells{std::move(kind), cursor_.count(kMostValues), {}, {}};
    const Index size = cursor_.count(kMostValues);
    if (cursor_.peek() == "OFFSETS") {
      cursor_.word();
      const FieldType type = cursor_.type();
      cells.offsets = cursor_.array(type, cells.count, context_);
      cells.count = std::max<Index>(cells.count - 1, 0);
      if (cursor_.word() != "CONNECTIVITY") throw cursor_.bad("expected CONNECTIVITY");
      cells.vertices = cursor_.array(cursor_.type(), size, context_);
    } else {
      cells.vertices = cursor_.array(FieldType::i32, size, context_);
    }
    cells_.push_back(std::move(cells));
  }

  void begin_data(bool of_points) {
    of_points_ = of_points;
    tuples_ = cursor_.count(kMostValues);
    if (of_points && points_ && tuples_ != points_->count / 3)
      throw cursor_.bad(
          fmt::format("POINT_DATA for {} points, there are {}", tuples_, points_->count / 3));
  }

  void read_attribute(std::string_view word) {
    const std::string kind(word);
    if (kind == "FIELD") return read_fields();
    if (kind == "LOOKUP_TABLE") return read_lookup_table();
    constexpr std::pair<std::string_view, Index> kWidths[] = {
        {"VECTORS", 3},    {"NORMALS", 3},      {"TENSORS", 9},   {"TENSORS6", 6},
        {"GLOBAL_IDS", 1}, {"PEDIGREE_IDS", 1}, {"EDGE_FLAGS", 1}};
    const std::string name(cursor_.word());
    if (kind == "SCALARS") return read_scalars(name);
    if (kind == "COLOR_SCALARS") {
      const Index width = cursor_.count(4);
      return keep("colour", width,
                  cursor_.array(cursor_.binary() ? FieldType::u8 : FieldType::f32, width * tuples_,
                                context_));
    }
    if (kind == "TEXTURE_COORDINATES") {
      const Index width = cursor_.count(3);
      const FieldType type = cursor_.type();
      return keep(name, width, cursor_.array(type, width * tuples_, context_));
    }
    for (const auto& [known, width] : kWidths) {
      if (known != kind) continue;
      const FieldType type = cursor_.type();
      return keep(kind == "NORMALS" ? "normals" : name, width,
                  cursor_.array(type, width * tuples_, context_));
    }
    throw cursor_.bad("found " + quote(kind) + ", expected a section of a legacy VTK file");
  }

  void read_scalars(const std::string& name) {
    const FieldType type = cursor_.type();
    Index width = 1;
    // The number of components may be left out, and so may be the lookup table's line.
    if (!cursor_.peek_on_line().empty()) width = cursor_.count(4);
    if (cursor_.peek() == "LOOKUP_TABLE") {
      cursor_.word();
      cursor_.word();
    }
    keep(name, width, cursor_.array(type, width * tuples_, context_));
  }

  void read_lookup_table() {
    cursor_.word();
    const Index size = cursor_.count(kMostValues / 4);
    (void)cursor_.array(cursor_.binary() ? FieldType::u8 : FieldType::f32, 4 * size, context_);
  }

  void read_fields() {
    cursor_.word();
    const Index arrays = cursor_.count(kMostComponents);
    for (Index i = 0; i < arrays; ++i) {
      if (cursor_.peek() == "METADATA")
        while (!cursor_.line().empty()) continue;
      const std::string name(cursor_.word());
      const Index width = cursor_.count(kMostComponents);
      const Index tuples = cursor_.count(kMostValues);
      const FieldType type = cursor_.type();
      const VtkArray array = cursor_.array(type, width * tuples, context_);
      if (of_points_ && tuples == tuples_) keep(name, width, array);
    }
  }

  void keep(const std::string& name, Index width, const VtkArray& array) {
    if (!of_points_ || width == 0) return;
    for (const Field& other : records_.fields)
      if (lower(other.name) == lower(name)) return;  // the first of a name counts
    const std::string lowered = lower(name);
    if (lowered == "x" || lowered == "y" || lowered == "z") return;
    records_.fields.push_back({name, array.type, width, array.data,
                               static_cast<std::size_t>(width) * size_of(array.type)});
  }

  [[nodiscard]] std::int64_t at(const VtkArray& array, Index i) const {
    return with_type(array.type, [&](auto typed) {
      using T = decltype(typed);
      return static_cast<std::int64_t>(
          load<T>(array.data + static_cast<std::size_t>(i) * sizeof(T), cursor_.binary()));
    });
  }

  void add_cells(const Cells& cells, Polygons& result) {
    Index next = 0;
    for (Index i = 0; i < cells.count; ++i) {
      if (i % (1 << 18) == 0) context_.check();
      Index begin = next + 1;
      std::int64_t size = 0;
      if (cells.offsets.data != nullptr) {
        begin = at(cells.offsets, i);
        size = at(cells.offsets, i + 1) - begin;
      } else if (next < cells.vertices.count) {
        size = at(cells.vertices, next);
      } else {
        begin = -1;
      }
      if (begin < 0 || size < 0 || size > cells.vertices.count ||
          begin > cells.vertices.count - size)
        throw Error(Fault::input, fmt::format("{}: cell {} lies outside of its {} vertices",
                                              cells.kind, i, cells.vertices.count))
            .at(source_.name());
      next = begin + size;
      add_cell(cells, i, begin, size, result);
    }
  }

  void add_cell(const Cells& cells, Index i, Index begin, std::int64_t size, Polygons& result) {
    constexpr std::int64_t kTriangle = 5;
    constexpr std::int64_t kStrip = 6;
    constexpr std::int64_t kPolygon = 7;
    constexpr std::int64_t kQuad = 9;
    std::int64_t type = cells.kind == "TRIANGLE_STRIPS" ? kStrip : kPolygon;
    if (cells.kind == "CELLS") type = types_ && i < types_->count ? at(*types_, i) : -1;
    if (type != kTriangle && type != kStrip && type != kPolygon && type != kQuad) return;
    polygon_.clear();
    for (Index c = 0; c < size; ++c) polygon_.push_back(at(cells.vertices, begin + c));
    bool good = true;
    if (type == kStrip) {
      for (std::size_t c = 2; c < polygon_.size(); ++c) {
        const std::size_t turn = c % 2;
        good = good && result.add(std::array<std::int64_t, 3>{polygon_[c - 2 + turn],
                                                              polygon_[c - 1 - turn], polygon_[c]},
                                  points_->count / 3);
      }
    } else {
      good = result.add(polygon_, points_->count / 3);
    }
    if (!good)
      throw Error(Fault::input, fmt::format("{}: cell {} has a vertex out of range; there are {}",
                                            cells.kind, i, points_->count / 3))
          .at(source_.name());
  }

  const Source& source_;
  Context& context_;
  VtkCursor cursor_;
  std::optional<VtkArray> points_;
  std::optional<VtkArray> types_;
  std::vector<Cells> cells_;
  Records records_;
  bool of_points_ = false;
  Index tuples_ = 0;
  std::vector<std::int64_t> polygon_;
};

}  // namespace

Cloud read_vtk_cloud(const Source& source, const ReadOptions& options, Context& context) {
  VtkReader reader(source, context);
  reader.read();
  return assemble(source, reader.records(), options, NotFinite::drop, context);
}

Mesh read_vtk_mesh(const Source& source, const ReadOptions& options, Context& context) {
  VtkReader reader(source, context);
  reader.read();
  const Polygons polygons = reader.polygons();
  if (polygons.corners.empty())
    throw Error(Fault::input, "the VTK file has no polygons: this is no mesh").at(source.name());
  return make_mesh(source, assemble(source, reader.records(), options, NotFinite::refuse, context),
                   polygons, options, context);
}

}  // namespace velum::formats
