// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "cad/exchange.hpp"

class TopoDS_Face;
class TopoDS_Shape;

namespace velum::cad {

/// The only face of `shape`; throws Error (Fault::output) when there is another number of them.
void only_face(const TopoDS_Shape& shape, TopoDS_Face& face);

/// Measures the face that was read against the surface, and its area, borders and their length
/// against those of the face that was written. Throws Error (Fault::output) where they differ by
/// more than `tolerance` [m] and what the file's digits explain.
Written compare(const TopoDS_Face& read, const TopoDS_Face& wrote, const Surface& surface,
                double tolerance);

}  // namespace velum::cad
