// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/assemble.hpp"
#include "velum/files.hpp"
#include "velum/mesh.hpp"

/// Binary glTF 2.0 (Khronos 2021, ISO/IEC 12113:2022): one file of JSON and binary data. Its
/// lengths are metres and its y is up, by its standard: the file's x, -z, y are x, y, z here.
namespace velum::formats {

/// All triangles of the file's scene, placed by its nodes, as one mesh. `options.unit` has no say.
Mesh read_glb(const Source& source, const ReadOptions& options, Context& context);
/// Positions, normals and colours; the mesh's origin is the translation of the file's only node.
void write_glb(AtomicFile& file, const Mesh& mesh, Context& context);

}  // namespace velum::formats
