// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/assemble.hpp"
#include "velum/files.hpp"
#include "velum/mesh.hpp"

/// Wavefront OBJ: polygons, normals and vertex colours; materials and groups are passed over.
namespace velum::formats {

Mesh read_obj(const Source& source, const ReadOptions& options, Context& context);
void write_obj(AtomicFile& file, const Mesh& mesh, double unit, Context& context);

}  // namespace velum::formats
