// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/assemble.hpp"

namespace velum::formats {

/// What a PCD file says of itself, checked in itself but not yet against the file's length.
struct PcdHeader {
  enum class Data { ascii, binary, compressed };
  std::vector<Field> fields;  ///< names, types and widths
  std::size_t stride = 0;     ///< bytes a point
  Index values = 0;           ///< values a point
  Index points = 0;
  Data data = Data::ascii;
  std::vector<Sensor> sensors;
  std::size_t body = 0;  ///< where the data begin
};

PcdHeader read_pcd_header(const Source& source);

}  // namespace velum::formats
