// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/mesh_io.hpp"

#include "formats/detect.hpp"
#include "formats/glb.hpp"
#include "formats/obj.hpp"
#include "formats/off.hpp"
#include "formats/ply.hpp"
#include "formats/stl.hpp"
#include "formats/vtk.hpp"

namespace velum::formats {
namespace {

Mesh read_known(Source& source, Format format, const ReadOptions& options, Context& context) {
  switch (format) {
    case Format::ply:
      return read_ply_mesh(source, options, context);
    case Format::vtk:
      return read_vtk_mesh(source, options, context);
    case Format::off:
      return read_off(source, options, context);
    case Format::obj:
      return read_obj(source, options, context);
    case Format::stl:
      return read_stl(source, options, context);
    case Format::glb:
      return read_glb(source, options, context);
    default:
      break;
  }
  throw Error(Fault::input, "a " + std::string(name_of(format)) +
                                " file has no mesh, expected ply, stl, obj, off, vtk or glb")
      .at(source.name())
      .hint("io.read_cloud reads its points");
}

}  // namespace

Mesh read_mesh(Source& source, const ReadOptions& options, Context& context) {
  Mesh mesh = read_known(source, detect(source), options, context);
  if (mesh.size() == 0 && mesh.vertices().size() > 0)
    throw Error(Fault::input, "the file has no faces: this is no mesh")
        .at(source.name())
        .hint("io.read_cloud reads its points");
  return mesh;
}

MeshFormat chosen(const std::filesystem::path& path, MeshFormat format) {
  if (format != MeshFormat::automatic) return format;
  const std::string extension = lower(path.extension().string());
  constexpr std::pair<std::string_view, MeshFormat> kFormats[] = {
      {".ply", MeshFormat::ply}, {".stl", MeshFormat::stl}, {".obj", MeshFormat::obj},
      {".off", MeshFormat::off}, {".vtk", MeshFormat::vtk}, {".glb", MeshFormat::glb}};
  for (const auto& [known, by_extension] : kFormats)
    if (known == extension) return by_extension;
  throw Error(Fault::graph, "no format is known for " + quote(path.filename().string()) +
                                ", expected .ply, .stl, .obj, .off, .vtk or .glb")
      .at("file")
      .hint("name the format by format = \"...\"");
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh, MeshFormat format, double unit,
                Context& context) {
  AtomicFile file(path);
  switch (chosen(path, format)) {
    case MeshFormat::automatic:
    case MeshFormat::ply:
      write_ply(file, mesh, false, unit, context);
      break;
    case MeshFormat::ply_ascii:
      write_ply(file, mesh, true, unit, context);
      break;
    case MeshFormat::stl:
      write_stl(file, mesh, false, unit, context);
      break;
    case MeshFormat::stl_ascii:
      write_stl(file, mesh, true, unit, context);
      break;
    case MeshFormat::obj:
      write_obj(file, mesh, unit, context);
      break;
    case MeshFormat::off:
      write_off(file, mesh, unit, context);
      break;
    case MeshFormat::vtk:
      write_vtk(file, mesh, false, unit, context);
      break;
    case MeshFormat::vtk_ascii:
      write_vtk(file, mesh, true, unit, context);
      break;
    case MeshFormat::glb:
      write_glb(file, mesh, context);
      break;
  }
  file.commit();
}

}  // namespace velum::formats
