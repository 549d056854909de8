// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "formats/source.hpp"

namespace velum::formats {

enum class Format { pcd, ply, las, vtk, off, obj, stl, glb, text };
std::string_view name_of(Format format);

/// What a file is, by its content first and its extension second. Throws Error (Fault::input) when
/// it is nothing that can be read, or when its extension promises a header that is not there.
Format detect(const Source& source);

/// The format that an extension (in lower case, with its dot) stands for.
std::optional<Format> format_of_extension(std::string_view extension);

}  // namespace velum::formats
