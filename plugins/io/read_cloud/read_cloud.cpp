// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "formats/cloud_io.hpp"

namespace {

using velum::Cloud;
using velum::Context;
namespace formats = velum::formats;

enum class Handedness { right, left };

struct ReadCloud {
  velum::InputFile file;
  velum::LengthUnit units;
  std::vector<std::string> columns;
  Handedness handedness = Handedness::right;

  static auto about() {
    velum::About<ReadCloud> about(
        "Reads a point cloud: PCD, PLY, LAS, legacy VTK, plain text (xyz, txt, csv, pts), or the "
        "vertices of a mesh");
    about.out("cloud", "the points that have finite coordinates, with the file's columns")
        .param(&ReadCloud::file, "file", "the file; its content decides what it is")
        .required()
        .param(&ReadCloud::units, "units", "unit of the file's lengths")
        .param(&ReadCloud::columns, "columns",
               "names of a text file's columns, in order, such as x, y, z, intensity; _ leaves one "
               "out; without it by the file's header or by their number")
        .choice(&ReadCloud::handedness, "handedness", "of the file's axes",
                {{"right", Handedness::right, "as they are"},
                 {"left", Handedness::left,
                  "left-handed with y up, as in 3DTK: the file's z, -x, y become x, y, z"}})
        .advanced();
    return about;
  }

  Cloud operator()(Context& context) const {
    formats::Source source(file.path);
    formats::ReadOptions options;
    options.unit = units.metres;
    options.columns = columns;
    options.left_handed = handedness == Handedness::left;
    Cloud cloud = formats::read_cloud(source, options, context);
    context.measure("points", static_cast<double>(cloud.size()), "");
    return cloud;
  }
};

}  // namespace

VELUM_STAGE(ReadCloud)
