// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "formats/ply_body.hpp"

namespace velum::formats {
namespace {

constexpr Index kRecordsBetweenChecks = 1 << 20;

std::int64_t load_integer(FieldType type, const std::byte* from, bool swapped) {
  return with_type(type, [&](auto typed) {
    return static_cast<std::int64_t>(load<decltype(typed)>(from, swapped));
  });
}

class BinaryReader {
 public:
  BinaryReader(const Source& source, const PlyHeader& header, bool faces, Context& context)
      : source_(source), header_(header), faces_(faces), context_(context), at_(header.body) {}

  PlyBody read() {
    for (const PlyElement& element : header_.elements)
      if (element.name == "vertex") vertices_ = element.count;
    body_.vertices.count = vertices_;
    body_.vertices.swapped = swapped();
    for (const PlyElement& element : header_.elements) read_element(element);
    source_.require_end(at_);
    return std::move(body_);
  }

 private:
  [[nodiscard]] bool swapped() const { return header_.format == PlyHeader::Format::big; }
  [[nodiscard]] std::size_t left() const { return source_.size() - at_; }
  [[nodiscard]] const std::byte* here() const { return source_.bytes().data() + at_; }

  void need(std::size_t bytes, const PlyElement& element) const {
    if (bytes > left())
      throw source_.bad_byte(source_.size(),
                             fmt::format("the file ends within element '{}': {} of at least {} "
                                         "bytes follow byte {}",
                                         element.name, left(), bytes, at_));
  }

  void read_element(const PlyElement& element) {
    const std::size_t bytes = static_cast<std::size_t>(element.count) * element.least_bytes();
    need(bytes, element);
    const bool vertex = element.name == "vertex";
    if (!element.has_lists()) {
      if (vertex) body_.vertices.fields = packed_fields(element, scalars(element), here());
      at_ += bytes;
      return;
    }
    if (vertex) {
      const std::vector<FieldType> types = scalars(element);
      std::size_t stride = 0;
      for (const FieldType type : types) stride += size_of(type);
      body_.rows = Buffer(stride * static_cast<std::size_t>(element.count));
      body_.vertices.fields = packed_fields(element, types, body_.rows.data.get());
    }
    std::byte* row = vertex ? body_.rows.data.get() : nullptr;
    for (Index i = 0; i < element.count; ++i) {
      if (i % kRecordsBetweenChecks == 0) context_.check();
      row = read_record(element, row);
    }
  }

  static std::vector<FieldType> scalars(const PlyElement& element) {
    std::vector<FieldType> types;
    for (const PlyProperty& property : element.properties)
      if (!property.list) types.push_back(property.type);
    return types;
  }

  /// Passes over one record with lists; its scalars go to `row` unless null. Returns the row's end.
  std::byte* read_record(const PlyElement& element, std::byte* row) {
    for (const PlyProperty& property : element.properties) {
      const std::size_t size = size_of(property.type);
      if (property.list) {
        read_list(element, property);
        continue;
      }
      need(size, element);
      if (row != nullptr) {
        std::memcpy(row, here(), size);
        row += size;
      }
      at_ += size;
    }
    return row;
  }

  void read_list(const PlyElement& element, const PlyProperty& property) {
    const std::size_t begin = at_;
    need(size_of(property.count_type), element);
    const std::int64_t count = load_integer(property.count_type, here(), swapped());
    at_ += size_of(property.count_type);
    const std::size_t size = size_of(property.type);
    if (count < 0 || static_cast<std::size_t>(count) > left() / size)
      throw source_.bad_byte(
          begin, fmt::format("a list of {} values in element '{}'; {} bytes follow", count,
                             element.name, left()));
    if (faces_ && is_corners(element, property)) {
      polygon_.clear();
      for (std::int64_t i = 0; i < count; ++i)
        polygon_.push_back(
            load_integer(property.type, here() + static_cast<std::size_t>(i) * size, swapped()));
      if (!body_.polygons.add(polygon_, vertices_))
        throw source_.bad_byte(
            begin, fmt::format("a face with a vertex out of range; there are {}", vertices_));
    }
    at_ += static_cast<std::size_t>(count) * size;
  }

  const Source& source_;
  const PlyHeader& header_;
  bool faces_;
  Context& context_;
  std::size_t at_;
  Index vertices_ = 0;
  std::vector<std::int64_t> polygon_;
  PlyBody body_;
};

}  // namespace

PlyBody read_ply_binary(const Source& source, const PlyHeader& header, bool faces,
                        Context& context) {
  return BinaryReader(source, header, faces, context).read();
}

}  // namespace velum::formats
