// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "formats/assemble.hpp"

namespace velum::formats {

/// The cloud in a file of any format that can be read; of a mesh its vertices.
Cloud read_cloud(Source& source, const ReadOptions& options, Context& context);

/// How to write a cloud; `automatic` goes by the file's extension.
enum class CloudFormat {
  automatic,
  pcd,
  pcd_ascii,
  pcd_compressed,
  ply,
  ply_ascii,
  xyz,
  csv,
  vtk,
  vtk_ascii
};

/// `format`, or what the file's extension stands for; throws Error (Fault::graph) at "file" when it
/// stands for none.
CloudFormat chosen(const std::filesystem::path& path, CloudFormat format);
/// Throws Error (Fault::output) naming the file when it cannot be written.
void write_cloud(const std::filesystem::path& path, const Cloud& cloud, CloudFormat format,
                 double unit, Context& context);

}  // namespace velum::formats
