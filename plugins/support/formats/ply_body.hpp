// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/ply_header.hpp"
#include "formats/polygons.hpp"
#include "formats/rows.hpp"

namespace velum::formats {

/// The data of a PLY file: vertices as records, faces as triangles if they are asked for.
struct PlyBody {
  Records vertices;
  Polygons polygons;
  Buffer rows{0};  ///< holds the vertices unless they stand in the file as they are
};

/// Reads the body, which must hold what the header promises and nothing more.
PlyBody read_ply_ascii(const Source& source, const PlyHeader& header, bool faces, Context& context);
PlyBody read_ply_binary(const Source& source, const PlyHeader& header, bool faces,
                        Context& context);

/// Is the property the list of a face's corners?
bool is_corners(const PlyElement& element, const PlyProperty& property);
/// Fields for the scalar properties of `element` in packed rows at `data`, lists left out.
std::vector<Field> packed_fields(const PlyElement& element, const std::vector<FieldType>& types,
                                 const std::byte* data);

}  // namespace velum::formats
