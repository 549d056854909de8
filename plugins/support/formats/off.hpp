// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/assemble.hpp"
#include "velum/files.hpp"
#include "velum/mesh.hpp"

/// Object File Format (Geomview), text: OFF, COFF (colours), NOFF (normals).
namespace velum::formats {

Mesh read_off(const Source& source, const ReadOptions& options, Context& context);
void write_off(AtomicFile& file, const Mesh& mesh, double unit, Context& context);

}  // namespace velum::formats
