// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "velum/values.hpp"

namespace velum::report {

/// Triangles of a surface, to be looked at: a grid in (u, v), cut off at the trimming loops. Where
/// a vertex lies on the border, it does so to a hundredth of a grid step. An empty mesh for a
/// surface that is not sound.
[[nodiscard]] Mesh sampled(const Surface& surface);

}  // namespace velum::report
