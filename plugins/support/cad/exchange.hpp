// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <velum/context.hpp>
#include <velum/values.hpp>

/// CAD files by OpenCASCADE.
namespace velum::cad {

enum class Exchange { step, iges };

/// What a file holds, as it was read back.
struct Written {
  Index loops = 0;             ///< closed borders of the face
  double area = 0.0;           ///< of the trimmed face [m²]
  double border_length = 0.0;  ///< of all borders [m]
  double surface_error = 0.0;  ///< greatest distance between both surfaces at one (u, v) [m]
  double border_error = 0.0;   ///< greatest distance of the loops' points from the borders [m]
};

/// Writes the trimmed face with its border curves in millimetres, AP214 in STEP; reads the file
/// back and compares surface, borders, area and length; only then it gets its name. The same
/// surface makes the same bytes. Throws Error: Fault::stage for a surface that is not sound,
/// Fault::output when the file cannot be written or does not hold what it should.
Written write_exchange(const std::filesystem::path& path, const Surface& surface, Exchange format,
                       double tolerance, Context& context);

}  // namespace velum::cad
