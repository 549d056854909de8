// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "formats/mesh_io.hpp"

namespace {

using velum::Context;
using velum::Mesh;
namespace formats = velum::formats;

enum class Handedness { right, left };

struct ReadMesh {
  velum::InputFile file;
  velum::LengthUnit units;
  Handedness handedness = Handedness::right;

  static auto about() {
    velum::About<ReadMesh> about("Reads a triangle mesh: PLY, STL, OBJ, OFF, legacy VTK or GLB");
    about.out("mesh", "the file's polygons as triangles, with its vertices' columns")
        .param(&ReadMesh::file, "file", "the file; its content decides what it is")
        .required()
        .param(&ReadMesh::units, "units", "unit of the file's lengths")
        .choice(&ReadMesh::handedness, "handedness", "of the file's axes",
                {{"right", Handedness::right, "as they are"},
                 {"left", Handedness::left,
                  "left-handed with y up: the file's z, -x, y become x, y, z"}})
        .advanced();
    return about;
  }

  Mesh operator()(Context& context) const {
    formats::Source source(file.path);
    formats::ReadOptions options;
    options.unit = units.metres;
    options.left_handed = handedness == Handedness::left;
    Mesh mesh = formats::read_mesh(source, options, context);
    context.measure("vertices", static_cast<double>(mesh.vertices().size()), "");
    context.measure("triangles", static_cast<double>(mesh.size()), "");
    return mesh;
  }
};

}  // namespace

VELUM_STAGE(ReadMesh)
