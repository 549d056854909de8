// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "formats/ply.hpp"
#include "formats/ply_body.hpp"

namespace velum::formats {
namespace {

const PlyElement* find(const PlyHeader& header, std::string_view name) {
  const auto found = std::find_if(header.elements.begin(), header.elements.end(),
                                  [&](const PlyElement& element) { return element.name == name; });
  return found == header.elements.end() ? nullptr : &*found;
}

PlyBody read_body(Source& source, bool faces, Context& context) {
  const PlyHeader header = read_ply_header(source);
  if (find(header, "vertex") == nullptr)
    throw Error(Fault::input, "the PLY header has no element 'vertex'").at(source.name());
  if (faces) {
    const PlyElement* face = find(header, "face");
    if (face == nullptr && find(header, "tristrips") != nullptr)
      throw Error(Fault::input, "triangle strips ('tristrips') are not read; expected 'face'")
          .at(source.name());
    if (face == nullptr)
      throw Error(Fault::input, "the PLY header has no element 'face': this is no mesh")
          .at(source.name())
          .hint("io.read_cloud reads its points");
    if (std::none_of(face->properties.begin(), face->properties.end(),
                     [&](const PlyProperty& property) { return is_corners(*face, property); }))
      throw Error(Fault::input, "element 'face' has no list 'vertex_indices' or 'vertex_index'")
          .at(source.name());
  }
  PlyBody body = header.format == PlyHeader::Format::ascii
                     ? read_ply_ascii(source, header, faces, context)
                     : read_ply_binary(source, header, faces, context);
  body.vertices.sensors = header.sensors;
  if (body.rows.size > 0) source.release();
  return body;
}

}  // namespace

bool is_corners(const PlyElement& element, const PlyProperty& property) {
  return element.name == "face" && property.list && !is_real(property.type) &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

std::vector<Field> packed_fields(const PlyElement& element, const std::vector<FieldType>& types,
                                 const std::byte* data) {
  std::size_t stride = 0;
  for (const FieldType type : types) stride += size_of(type);
  std::vector<Field> fields;
  auto type = types.begin();
  for (const PlyProperty& property : element.properties) {
    if (property.list) continue;
    fields.push_back({property.name, *type, 1, data, stride});
    data += size_of(*type++);
  }
  return fields;
}

Cloud read_ply_cloud(Source& source, const ReadOptions& options, Context& context) {
  const PlyBody body = read_body(source, false, context);
  return assemble(source, body.vertices, options, NotFinite::drop, context);
}

Mesh read_ply_mesh(Source& source, const ReadOptions& options, Context& context) {
  const PlyBody body = read_body(source, true, context);
  return make_mesh(source, assemble(source, body.vertices, options, NotFinite::refuse, context),
                   body.polygons, options, context);
}

}  // namespace velum::formats
