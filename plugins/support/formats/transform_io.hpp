// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/source.hpp"
#include "velum/parameter.hpp"
#include "velum/values.hpp"

/// A rigid motion as text (16 numbers, row after row, comments before them) or JSON.
namespace velum::formats {

struct TransformOptions {
  double unit = 1.0;  ///< of the translation [m], where the file names none
  /// Place of the matrix within a JSON file, as a JSON pointer ("/world_from_scan/bun045"); empty:
  /// the file itself or its entry "matrix".
  std::string entry;
};

/// Throws Error (Fault::input) for anything but a rigid motion, with the deviation from one.
Transform read_transform(const Source& source, const TransformOptions& options);

enum class TransformFormat { automatic, text, json };
void write_transform(const std::filesystem::path& path, const Transform& transform,
                     TransformFormat format, const LengthUnit& unit);

/// The rigid motion closest to a 4×4 matrix; throws Error saying by how much it is none when that
/// is more than the rounding of a text file.
Pose rigid_motion(const Source& source, const Eigen::Matrix4d& matrix);

}  // namespace velum::formats
