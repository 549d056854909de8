// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include <algorithm>
#include <cctype>

#include "bspline/evaluate.hpp"
#include "bspline/tessellate.hpp"
#include "cad/exchange.hpp"
#include "formats/mesh_io.hpp"

namespace {

using velum::Better;
using velum::Context;
using velum::Surface;
using velum::cad::Exchange;
using velum::formats::MeshFormat;

enum class Format { automatic, step, iges, stl, obj, ply, off, vtk, glb };

/// Share of the control net's extent that an edge of the mesh has unless said otherwise.
constexpr double kMeshShare = 0.01;

struct WriteSurface {
  velum::OutputFile file;
  velum::LengthUnit units;
  Format format = Format::automatic;
  velum::Length tolerance{1e-5};
  std::optional<velum::Length> mesh_size;

  static auto about() {
    return velum::About<WriteSurface>(
               "Writes a trimmed B-spline surface: STEP AP214 and IGES as a face with its border "
               "curves, STL, OBJ, PLY, OFF, VTK and GLB as triangles.")
        .in("surface", "what to write")
        .param(&WriteSurface::file, "file", "the file to write")
        .required()
        .param(&WriteSurface::units, "units",
               "unit of meshes that do not name theirs; STEP and IGES are in millimetres and say "
               "so, GLB is in metres")
        .choice(&WriteSurface::format, "format", "how to write it",
                {{"auto", Format::automatic, "by the file's extension"},
                 {"step", Format::step, "STEP AP214 (.step, .stp): exact, with border curves"},
                 {"iges", Format::iges, "IGES 5.3 (.iges, .igs): exact, with border curves"},
                 {"stl", Format::stl, "STL, binary: its mesh"},
                 {"obj", Format::obj, "OBJ: its mesh"},
                 {"ply", Format::ply, "PLY, binary: its mesh"},
                 {"off", Format::off, "OFF: its mesh"},
                 {"vtk", Format::vtk, "legacy VTK, binary: its mesh"},
                 {"glb", Format::glb, "binary glTF 2.0: its mesh"}})
        .param(&WriteSurface::tolerance, "tolerance",
               "how closely the border curves in space follow those on the surface",
               velum::Range{.low = 1e-7, .high = 1e-3})
        .advanced()
        .param(&WriteSurface::mesh_size, "mesh_size",
               "edges of the mesh; unset: a hundredth of the surface's extent", velum::above(0.0))
        .reference("ISO 10303-214; IGES 5.3 entities 128, 142 and 144")
        .licence("MIT AND GPL-3.0-or-later AND LGPL-2.1-only WITH OCCT-exception-1.0");
  }

  void check() const { static_cast<void>(chosen()); }
  void operator()(const Surface& surface, Context& context) const;

 private:
  [[nodiscard]] Format chosen() const;
  void write_exact(const Surface& surface, Exchange exchange, Context& context) const;
  void write_triangles(const Surface& surface, MeshFormat mesh_format, Context& context) const;
};

Format WriteSurface::chosen() const {
  if (format != Format::automatic) return format;
  std::string extension = file.path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::pair<std::string_view, Format> kKnown[] = {
      {".step", Format::step}, {".stp", Format::step}, {".iges", Format::iges},
      {".igs", Format::iges},  {".stl", Format::stl},  {".obj", Format::obj},
      {".ply", Format::ply},   {".off", Format::off},  {".vtk", Format::vtk},
      {".glb", Format::glb}};
  for (const auto& [known, value] : kKnown)
    if (known == extension) return value;
  throw velum::Error(
      velum::Fault::graph,
      "no format is known for '" + file.path.filename().string() +
          "', expected .step, .stp, .iges, .igs, .stl, .obj, .ply, .off, .vtk or .glb")
      .at("file")
      .hint("name the format by format = \"...\"");
}

void WriteSurface::write_exact(const Surface& surface, Exchange exchange, Context& context) const {
  const velum::cad::Written found =
      velum::cad::write_exchange(file.path, surface, exchange, tolerance, context);
  context.measure("loops", static_cast<double>(found.loops), "");
  context.measure("area", found.area, "m^2");
  context.measure("border_length", found.border_length, "m");
  context.measure("surface_error", found.surface_error, "m", Better::lower);
  context.measure("border_error", found.border_error, "m", Better::lower);
}

void WriteSurface::write_triangles(const Surface& surface, MeshFormat mesh_format,
                                   Context& context) const {
  const velum::bspline::Patch sound(surface);
  const double extent =
      (surface.control.rowwise().maxCoeff() - surface.control.rowwise().minCoeff()).norm();
  const double size = mesh_size ? mesh_size->value : kMeshShare * extent;
  if (!(size > 0.0))
    throw velum::Error(velum::Fault::stage,
                       "the surface has no extent: all control points are one");
  const velum::bspline::Tessellation made = velum::bspline::tessellate(surface, size, context);
  velum::formats::write_mesh(file.path, made.mesh, mesh_format, units.metres, context);
  context.measure("vertices", static_cast<double>(made.mesh.vertices().size()), "");
  context.measure("triangles", static_cast<double>(made.mesh.size()), "");
}

void WriteSurface::operator()(const Surface& surface, Context& context) const {
  context.check();
  switch (chosen()) {
    case Format::step:
      return write_exact(surface, Exchange::step, context);
    case Format::iges:
      return write_exact(surface, Exchange::iges, context);
    case Format::stl:
      return write_triangles(surface, MeshFormat::stl, context);
    case Format::obj:
      return write_triangles(surface, MeshFormat::obj, context);
    case Format::off:
      return write_triangles(surface, MeshFormat::off, context);
    case Format::vtk:
      return write_triangles(surface, MeshFormat::vtk, context);
    case Format::glb:
      return write_triangles(surface, MeshFormat::glb, context);
    case Format::automatic:
    case Format::ply:
      return write_triangles(surface, MeshFormat::ply, context);
  }
}

}  // namespace
VELUM_STAGE(WriteSurface)
