// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "cad/exchange.hpp"

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <velum/files.hpp>

#include "cad/compare.hpp"
#include "cad/face.hpp"
#include "cad/library.hpp"

namespace velum::cad {

Written write_exchange(const std::filesystem::path& path, const Surface& surface, Exchange format,
                       double tolerance, Context& context) {
  context.check();
  TopoDS_Face wrote;
  guarded(Fault::stage, "making a face", [&] { make_face(surface, tolerance, wrote); });
  context.check();
  AtomicFile file(path);
  guarded(Fault::output, "writing " + path.string(),
          [&] { write_shape(wrote, format, file.aside(), path.stem().string()); });
  context.check();
  context.progress(0.5);
  Written found;
  guarded(Fault::output, "reading back " + path.string(), [&] {
    TopoDS_Shape shape;
    read_shape(file.aside(), format, shape);
    TopoDS_Face read;
    only_face(shape, read);
    found = compare(read, wrote, surface, tolerance);
  });
  context.check();
  file.adopt();
  file.commit();
  return found;
}

}  // namespace velum::cad
