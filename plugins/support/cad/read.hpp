// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "cad/exchange.hpp"

namespace velum::cad {

/// STEP or IGES by how the file begins; throws Error (Fault::input) when it is neither.
Exchange format_of(const std::filesystem::path& path);

/// The only face of a STEP or IGES file as a trimmed B-spline surface in metres, whatever the
/// file's unit is. Planes, cylinders, surfaces of revolution and the like are expressed as
/// B-splines, which is exact; periodic ones are cut open. Trimming loops follow the border curves
/// within `tolerance` [m]; a face that is not trimmed has none. Throws Error (Fault::input) saying
/// what was found when the file is not whole, cannot be understood, or holds other than one face.
Surface read_exchange(const std::filesystem::path& path, double tolerance, Context& context);

}  // namespace velum::cad
