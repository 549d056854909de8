// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "cad/read.hpp"

#include <fmt/format.h>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <TopAbs_ShapeEnum.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <velum/files.hpp>

#include "cad/library.hpp"
#include "cad/unface.hpp"

namespace velum::cad {
namespace {

/// In IGES, the column that tells a line's section, counted from 0; the sections are S, G, D, P, T.
constexpr std::size_t kSection = 72;

bool is_iges(std::string_view text) {
  return text.size() > kSection + 8 && text[kSection] == 'S' &&
         text.substr(0, kSection).find('\n') == std::string_view::npos;
}

/// The library's parsers are not asked to read half a file.
void require_end(const std::filesystem::path& path, std::string_view text, Exchange format) {
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  const std::string_view body = text.substr(0, last == std::string_view::npos ? 0 : last + 1);
  const std::size_t line = body.rfind('\n') == std::string_view::npos ? 0 : body.rfind('\n') + 1;
  const bool whole = format == Exchange::step
                         ? body.ends_with("END-ISO-10303-21;")
                         : body.size() - line > kSection && body.substr(line)[kSection] == 'T';
  if (!whole)
    throw Error(Fault::input, format == Exchange::step
                                  ? "the file does not end in END-ISO-10303-21;: it is not whole"
                                  : "the file does not end in a line of section T: it is not whole")
        .at(path.string());
}

std::string counted(const TopoDS_Shape& shape) {
  constexpr std::pair<TopAbs_ShapeEnum, const char*> kKinds[] = {
      {TopAbs_SOLID, "solids"}, {TopAbs_FACE, "faces"}, {TopAbs_EDGE, "edges"}};
  std::string text;
  for (const auto& [kind, name] : kKinds) {
    Index count = 0;
    if (!shape.IsNull())
      for (TopExp_Explorer at(shape, kind); at.More(); at.Next()) ++count;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
  }
  return text;
}

TopoDS_Face face_of(const std::filesystem::path& path, const TopoDS_Shape& shape) {
  TopoDS_Face face;
  Index count = 0;
  if (!shape.IsNull())
    for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next(), ++count)
      face = TopoDS::Face(at.Current());
  if (count != 1)
    throw Error(Fault::input, "the file holds " + counted(shape) + ", expected one face")
        .at(path.string())
        .hint("export the one surface that is meant");
  return face;
}

}  // namespace

Exchange format_of(const std::filesystem::path& path) {
  const FileContent content(path);
  const std::string_view text = content.text();
  if (text.starts_with("ISO-10303-21;")) return Exchange::step;
  if (is_iges(text)) return Exchange::iges;
  throw Error(Fault::input,
              "the file begins neither as STEP (ISO-10303-21;) nor as IGES (a line of "
              "section S)")
      .at(path.string());
}

Surface read_exchange(const std::filesystem::path& path, double tolerance, Context& context) {
  const Exchange format = format_of(path);
  require_end(path, FileContent(path).text(), format);
  context.check();
  Surface surface;
  guarded(Fault::input, "reading " + path.string(), [&] {
    TopoDS_Shape shape;
    transfer(path, format, Fault::input, shape);
    const TopoDS_Face face = face_of(path, shape);
    context.check();
    BRepBuilderAPI_NurbsConvert converted(face);
    if (!converted.IsDone())
      throw Error(Fault::input, "OpenCASCADE cannot express the face as a B-spline surface")
          .at(path.string());
    try {
      surface = unface(TopoDS::Face(converted.Shape()), tolerance);
    } catch (const Error& error) {  // a surface that is not sound
      throw Error(Fault::input, error.what()).at(path.string()).hint(error.hint());
    }
  });
  return surface;
}

}  // namespace velum::cad
