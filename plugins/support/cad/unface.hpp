// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/values.hpp>

class TopoDS_Face;

namespace velum::cad {

/// The inverse of make_face: a face over a B-spline surface, in millimetres, as a surface in metres
/// with its wires as trimming loops, none where they are the surface's own border. A periodic
/// surface is cut where its range begins. `tolerance` [m]: how far a loop's straight steps in (u,
/// v) may leave the border curves. Throws Error (Fault::input) where this cannot be.
Surface unface(const TopoDS_Face& face, double tolerance);

}  // namespace velum::cad
