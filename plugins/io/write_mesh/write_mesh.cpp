// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "formats/mesh_io.hpp"

namespace {

using velum::Context;
using velum::Mesh;
using velum::formats::MeshFormat;

struct WriteMesh {
  velum::OutputFile file;
  velum::LengthUnit units;
  MeshFormat format = MeshFormat::automatic;

  static auto about() {
    velum::About<WriteMesh> about("Writes a triangle mesh: PLY, STL, OBJ, OFF, legacy VTK or GLB");
    about.in("mesh", "what to write")
        .param(&WriteMesh::file, "file", "the file to write")
        .required()
        .param(&WriteMesh::units, "units", "unit of the file's lengths")
        .choice(&WriteMesh::format, "format", "how to write it",
                {{"auto", MeshFormat::automatic, "by the file's extension; binary where it can be"},
                 {"ply", MeshFormat::ply, "PLY, binary, little-endian, with all columns"},
                 {"ply_ascii", MeshFormat::ply_ascii, "PLY, text, with all columns"},
                 {"stl", MeshFormat::stl, "STL, binary; single precision, no columns"},
                 {"stl_ascii", MeshFormat::stl_ascii, "STL, text; no columns"},
                 {"obj", MeshFormat::obj, "OBJ, with normals and colours"},
                 {"off", MeshFormat::off, "OFF; no columns"},
                 {"vtk", MeshFormat::vtk, "legacy VTK, binary, with all columns"},
                 {"vtk_ascii", MeshFormat::vtk_ascii, "legacy VTK, text, with all columns"},
                 {"glb", MeshFormat::glb, "binary glTF 2.0, always in metres; normals, colours"}});
    return about;
  }

  void check() const { velum::formats::chosen(file.path, format); }

  void operator()(const Mesh& mesh, Context& context) const {
    velum::formats::write_mesh(file.path, mesh, format, units.metres, context);
    context.measure("vertices", static_cast<double>(mesh.vertices().size()), "");
    context.measure("triangles", static_cast<double>(mesh.size()), "");
  }
};

}  // namespace

VELUM_STAGE(WriteMesh)
