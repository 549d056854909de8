// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/assemble.hpp"
#include "velum/mesh.hpp"

namespace velum::formats {

/// The mesh in a file of any format that can be read; polygons become triangles.
Mesh read_mesh(Source& source, const ReadOptions& options, Context& context);

/// How to write a mesh; `automatic` goes by the file's extension.
enum class MeshFormat { automatic, ply, ply_ascii, stl, stl_ascii, obj, off, vtk, vtk_ascii, glb };

/// `format`, or what the file's extension stands for; throws Error (Fault::graph) at "file" when it
/// stands for none.
MeshFormat chosen(const std::filesystem::path& path, MeshFormat format);
/// Throws Error (Fault::output) naming the file when it cannot be written. GLB is in metres
/// whatever `unit` is.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh, MeshFormat format, double unit,
                Context& context);

}  // namespace velum::formats
