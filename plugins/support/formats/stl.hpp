// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/assemble.hpp"
#include "velum/files.hpp"
#include "velum/mesh.hpp"

/// Stereolithography, binary and text.
namespace velum::formats {

/// Vertices of equal coordinates become one.
Mesh read_stl(const Source& source, const ReadOptions& options, Context& context);
void write_stl(AtomicFile& file, const Mesh& mesh, bool ascii, double unit, Context& context);

}  // namespace velum::formats
