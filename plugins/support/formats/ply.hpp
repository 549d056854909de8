// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/assemble.hpp"
#include "velum/files.hpp"
#include "velum/mesh.hpp"

/// Polygon File Format (Stanford), version 1.0.
namespace velum::formats {

/// The vertices; faces and all other elements are passed over, but must be there.
Cloud read_ply_cloud(Source& source, const ReadOptions& options, Context& context);
Mesh read_ply_mesh(Source& source, const ReadOptions& options, Context& context);

void write_ply(AtomicFile& file, const Cloud& cloud, bool ascii, double unit, Context& context);
void write_ply(AtomicFile& file, const Mesh& mesh, bool ascii, double unit, Context& context);

}  // namespace velum::formats
