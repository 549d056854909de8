// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/assemble.hpp"

namespace velum::formats {

struct PlyProperty {
  std::string name;
  FieldType type = FieldType::f32;
  bool list = false;
  FieldType count_type = FieldType::u8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  Index count = 0;
  std::vector<PlyProperty> properties;

  [[nodiscard]] bool has_lists() const;
  /// Bytes of a record in a binary file; lists count as empty.
  [[nodiscard]] std::size_t least_bytes() const;
};

/// What a PLY file says of itself, not yet checked against the file's length.
struct PlyHeader {
  enum class Format { ascii, little, big };
  Format format = Format::ascii;
  std::vector<PlyElement> elements;
  std::vector<Sensor> sensors;
  std::size_t body = 0;  ///< where the data begin
};

PlyHeader read_ply_header(const Source& source);

}  // namespace velum::formats
