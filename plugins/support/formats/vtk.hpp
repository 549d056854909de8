// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/assemble.hpp"
#include "velum/files.hpp"
#include "velum/mesh.hpp"

/// Legacy VTK files, text and binary: points with point data, polygons.
namespace velum::formats {

Cloud read_vtk_cloud(const Source& source, const ReadOptions& options, Context& context);
Mesh read_vtk_mesh(const Source& source, const ReadOptions& options, Context& context);

void write_vtk(AtomicFile& file, const Cloud& cloud, bool ascii, double unit, Context& context);
void write_vtk(AtomicFile& file, const Mesh& mesh, bool ascii, double unit, Context& context);

}  // namespace velum::formats
