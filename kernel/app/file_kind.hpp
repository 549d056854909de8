// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace velum::app {

/// What a file may hold, and so which reader and writer it takes.
enum class FileKind { cloud, mesh, transform, recording };

/// By its name and, for formats that hold several kinds (ply, vtk, txt), by its beginning. Throws
/// Error: Fault::graph when the file is not there or the format is unknown.
FileKind kind_of_input(const std::filesystem::path& path);
/// By its name: clouds may be written where meshes may, not the other way round, unless `input` is
/// a mesh whose vertices are to be kept. Throws Error (Fault::graph) when it cannot be.
FileKind kind_of_output(const std::filesystem::path& path, FileKind input);

std::string reader_of(FileKind kind);
std::string writer_of(FileKind kind);

}  // namespace velum::app
