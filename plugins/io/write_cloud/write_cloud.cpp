// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "formats/cloud_io.hpp"

namespace {

using velum::Cloud;
using velum::Context;
using velum::formats::CloudFormat;

struct WriteCloud {
  velum::OutputFile file;
  velum::LengthUnit units;
  CloudFormat format = CloudFormat::automatic;

  static auto about() {
    velum::About<WriteCloud> about("Writes a point cloud: PCD, PLY, legacy VTK or plain text");
    about.in("cloud", "what to write, with all its columns")
        .param(&WriteCloud::file, "file", "the file to write")
        .required()
        .param(&WriteCloud::units, "units", "unit of the file's lengths")
        .choice(
            &WriteCloud::format, "format", "how to write it",
            {{"auto", CloudFormat::automatic, "by the file's extension; binary where it can be"},
             {"pcd", CloudFormat::pcd, "PCD 0.7, binary"},
             {"pcd_ascii", CloudFormat::pcd_ascii, "PCD 0.7, text"},
             {"pcd_compressed", CloudFormat::pcd_compressed, "PCD 0.7, binary_compressed"},
             {"ply", CloudFormat::ply, "PLY, binary, little-endian"},
             {"ply_ascii", CloudFormat::ply_ascii, "PLY, text"},
             {"xyz", CloudFormat::xyz, "text, blanks between values; a comment names them"},
             {"csv", CloudFormat::csv, "text, commas between values; the first line names them"},
             {"vtk", CloudFormat::vtk, "legacy VTK, binary"},
             {"vtk_ascii", CloudFormat::vtk_ascii, "legacy VTK, text"}});
    return about;
  }

  void check() const { velum::formats::chosen(file.path, format); }

  void operator()(const Cloud& cloud, Context& context) const {
    velum::formats::write_cloud(file.path, cloud, format, units.metres, context);
    context.measure("points", static_cast<double>(cloud.size()), "");
  }
};

}  // namespace

VELUM_STAGE(WriteCloud)
