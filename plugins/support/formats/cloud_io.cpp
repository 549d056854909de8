// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/cloud_io.hpp"

#include "formats/detect.hpp"
#include "formats/glb.hpp"
#include "formats/las.hpp"
#include "formats/obj.hpp"
#include "formats/off.hpp"
#include "formats/pcd.hpp"
#include "formats/ply.hpp"
#include "formats/stl.hpp"
#include "formats/text.hpp"
#include "formats/vtk.hpp"

namespace velum::formats {
namespace {

/// A mesh has no vertices to drop: it is refused when one is not finite.
Cloud vertices_of(const Mesh& mesh, Context& context) {
  context.measure("dropped", 0.0, "", Better::lower);
  return mesh.vertices();
}

}  // namespace

Cloud read_cloud(Source& source, const ReadOptions& options, Context& context) {
  const Format format = detect(source);
  if (!options.columns.empty() && format != Format::text)
    throw Error(Fault::graph, "'columns' names those of a text file, but this is a " +
                                  std::string(name_of(format)) + " file, which names its own")
        .at(source.name());
  switch (format) {
    case Format::pcd:
      return read_pcd(source, options, context);
    case Format::ply:
      return read_ply_cloud(source, options, context);
    case Format::text:
      return read_text(source, options, context);
    case Format::las:
      return read_las(source, options, context);
    case Format::vtk:
      return read_vtk_cloud(source, options, context);
    case Format::off:
      return vertices_of(read_off(source, options, context), context);
    case Format::obj:
      return vertices_of(read_obj(source, options, context), context);
    case Format::glb:
      return vertices_of(read_glb(source, options, context), context);
    case Format::stl:
      break;
  }
  return vertices_of(read_stl(source, options, context), context);
}

CloudFormat chosen(const std::filesystem::path& path, CloudFormat format) {
  if (format != CloudFormat::automatic) return format;
  const std::string extension = lower(path.extension().string());
  constexpr std::pair<std::string_view, CloudFormat> kFormats[] = {
      {".pcd", CloudFormat::pcd}, {".ply", CloudFormat::ply}, {".xyz", CloudFormat::xyz},
      {".txt", CloudFormat::xyz}, {".asc", CloudFormat::xyz}, {".csv", CloudFormat::csv},
      {".vtk", CloudFormat::vtk}};
  for (const auto& [known, by_extension] : kFormats)
    if (known == extension) return by_extension;
  throw Error(Fault::graph, "no format is known for " + quote(path.filename().string()) +
                                ", expected .pcd, .ply, .xyz, .txt, .asc, .csv or .vtk")
      .at("file")
      .hint("name the format by format = \"...\"");
}

void write_cloud(const std::filesystem::path& path, const Cloud& cloud, CloudFormat format,
                 double unit, Context& context) {
  AtomicFile file(path);
  switch (chosen(path, format)) {
    case CloudFormat::automatic:
    case CloudFormat::pcd:
      write_pcd(file, cloud, PcdKind::binary, unit, context);
      break;
    case CloudFormat::pcd_ascii:
      write_pcd(file, cloud, PcdKind::ascii, unit, context);
      break;
    case CloudFormat::pcd_compressed:
      write_pcd(file, cloud, PcdKind::compressed, unit, context);
      break;
    case CloudFormat::ply:
      write_ply(file, cloud, false, unit, context);
      break;
    case CloudFormat::ply_ascii:
      write_ply(file, cloud, true, unit, context);
      break;
    case CloudFormat::xyz:
      write_text(file, cloud, TextKind::xyz, unit, context);
      break;
    case CloudFormat::csv:
      write_text(file, cloud, TextKind::csv, unit, context);
      break;
    case CloudFormat::vtk:
      write_vtk(file, cloud, false, unit, context);
      break;
    case CloudFormat::vtk_ascii:
      write_vtk(file, cloud, true, unit, context);
      break;
  }
  file.commit();
}

}  // namespace velum::formats
