// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace velum::app {

/// What a file may hold, and so which reader and writer it takes.
enum class FileKind { cloud, mesh, surface, transform, recording };

/// By its beginning and, where that does not say, by its name. Throws Error: Fault::graph when the
/// file is not there or the format is unknown.
FileKind kind_of_input(const std::filesystem::path& path);
/// By its name: a mesh may become a cloud, its vertices; a surface stays one, also where it is
/// written as triangles. Throws Error (Fault::graph) when it cannot be.
FileKind kind_of_output(const std::filesystem::path& path, FileKind input);

std::string reader_of(FileKind kind);
std::string writer_of(FileKind kind);

}  // namespace velum::app
