// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/values.hpp>

class TopoDS_Face;

namespace velum::cad {

/// Millimetres a metre: what the library, and the files, count in.
inline constexpr double kMillimetres = 1000.0;

/// The surface as a face of OpenCASCADE in millimetres, origin included, with its trimming loops as
/// wires: curves through all their points, cut at corners. `tolerance` [m] is how well the borders'
/// curves in space follow those in (u, v). Throws Error (Fault::stage) where this is no valid face.
void make_face(const Surface& surface, double tolerance, TopoDS_Face& face);

}  // namespace velum::cad
