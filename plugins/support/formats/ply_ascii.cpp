// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "formats/ply_body.hpp"

namespace velum::formats {
namespace {

/// Types of the vertices' scalars in memory. The text may hold more digits than the type that the
/// header states: coordinates keep them.
std::vector<FieldType> stored_types(const PlyElement& element) {
  std::vector<FieldType> types;
  for (const PlyProperty& property : element.properties) {
    if (property.list) continue;
    const std::string name = lower(property.name);
    const bool coordinate = name == "x" || name == "y" || name == "z";
    types.push_back(coordinate && property.type == FieldType::f32 ? FieldType::f64 : property.type);
  }
  return types;
}

/// Reads one line with lists.
class LineReader {
 public:
  LineReader(const Source& source, const PlyElement& element, std::string_view line)
      : source_(source),
        element_(element),
        line_(line),
        at_(line.data()),
        end_(line.data() + line.size()) {}

  /// Scalars go to `row` with the given types unless it is null; corners of a face to `corners`.
  void read(std::byte* row, const std::vector<FieldType>& types,
            std::vector<std::int64_t>* corners) {
    std::size_t scalar = 0;
    for (const PlyProperty& property : element_.properties) {
      if (property.list) {
        read_list(property,
                  corners != nullptr && is_corners(element_, property) ? corners : nullptr);
        continue;
      }
      const FieldType type = types[scalar++];
      std::byte unused[8];
      take(type, row == nullptr ? unused : row);
      if (row != nullptr) row += size_of(type);
    }
    if (at_ != end_) refuse("the end of the line");
  }

 private:
  [[noreturn]] void refuse(const std::string& expected) const {
    const std::string found =
        at_ == end_ ? "the end of the line" : quote({at_, static_cast<std::size_t>(end_ - at_)});
    throw source_.bad_line(line_, fmt::format("found {} in element '{}', expected {}", found,
                                              element_.name, expected));
  }

  void take(FieldType type, std::byte* to) {
    const char* stop = parse_value(at_, end_, type, to);
    if (stop == nullptr || (stop != end_ && !is_blank(*stop)))
      refuse(fmt::format("a number of type {}", name_of(type)));
    at_ = stop;
    while (at_ != end_ && is_blank(*at_)) ++at_;
  }

  void read_list(const PlyProperty& property, std::vector<std::int64_t>* values) {
    std::byte value[8];
    take(FieldType::i64, value);
    const auto count = load<std::int64_t>(value, false);
    // Each value takes a character and, but for the last, a blank.
    if (count < 0 || count > (end_ - at_ + 1) / 2)
      throw source_.bad_line(line_,
                             fmt::format("a list of {} values in element '{}' on a line with "
                                         "{} characters left",
                                         count, element_.name, end_ - at_));
    for (std::int64_t i = 0; i < count; ++i) {
      if (values == nullptr) {
        take(property.type, value);
      } else {
        take(FieldType::i64, value);
        values->push_back(load<std::int64_t>(value, false));
      }
    }
  }

  const Source& source_;
  const PlyElement& element_;
  std::string_view line_;
  const char* at_;
  const char* end_;
};

class AsciiReader {
 public:
  AsciiReader(const Source& source, const PlyHeader& header, bool faces, Context& context)
      : source_(source),
        header_(header),
        faces_(faces),
        context_(context),
        lines_(split_lines(source.text().substr(header.body), false, context)) {}

  PlyBody read() {
    Index total = 0;
    for (const PlyElement& element : header_.elements) {
      total += element.properties.empty() ? 0 : element.count;
      if (element.name == "vertex") body_.vertices.count = element.count;
    }
    if (lines_.count != total)
      throw source_.bad_line(
          source_.size(), fmt::format("found {} lines of data, expected {}", lines_.count, total));
    Index first = 0;
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      if (element.name == "vertex")
        read_vertices(element, first);
      else if (faces_ && element.name == "face")
        read_faces(element, first);
      first += element.count;
    }
    return std::move(body_);
  }

 private:
  void read_vertices(const PlyElement& element, Index first) {
    const std::vector<FieldType> types = stored_types(element);
    RowLayout layout;
    for (const FieldType type : types) layout.add(type);
    if (!element.has_lists()) {
      body_.rows = parse_rows(source_, lines_, first, element.count, layout, context_);
    } else {
      body_.rows = Buffer(static_cast<std::size_t>(element.count) * layout.stride);
      visit(first, element.count, [&](std::size_t, std::string_view line, Index i) {
        LineReader(source_, element, line)
            .read(body_.rows.data.get() + static_cast<std::size_t>(i) * layout.stride, types,
                  nullptr);
      });
    }
    body_.vertices.fields = packed_fields(element, types, body_.rows.data.get());
  }

  void read_faces(const PlyElement& element, Index first) {
    std::vector<FieldType> types;
    for (const PlyProperty& property : element.properties)
      if (!property.list) types.push_back(property.type);
    std::vector<Polygons> parts(lines_.blocks.size());
    const Index vertices = body_.vertices.count;
    visit(first, element.count, [&](std::size_t block, std::string_view line, Index) {
      std::vector<std::int64_t> corners;
      LineReader(source_, element, line).read(nullptr, types, &corners);
      if (!parts[block].add(corners, vertices))
        throw source_.bad_line(
            line, fmt::format("a face with a vertex out of range; there are {}", vertices));
    });
    for (const Polygons& part : parts) body_.polygons.append(part);
  }

  /// Calls each(block, line, number) for `count` lines from `first`, on several threads.
  template <class Each>
  void visit(Index first, Index count, const Each& each) {
    context_.run_chunks(static_cast<Index>(lines_.blocks.size()), [&](Index b) {
      const Lines::Block& block = lines_.blocks[static_cast<std::size_t>(b)];
      if (block.first + block.count <= first || block.first >= first + count) return;
      each_line(lines_, block, [&](std::string_view line, Index number) {
        if (number >= first && number < first + count)
          each(static_cast<std::size_t>(b), line, number - first);
      });
    });
  }

  const Source& source_;
  const PlyHeader& header_;
  bool faces_;
  Context& context_;
  Lines lines_;
  PlyBody body_;
};

}  // namespace

PlyBody read_ply_ascii(const Source& source, const PlyHeader& header, bool faces,
                       Context& context) {
  return AsciiReader(source, header, faces, context).read();
}

}  // namespace velum::formats
