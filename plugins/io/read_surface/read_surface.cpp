// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "cad/read.hpp"

namespace {

using velum::Context;
using velum::Surface;

struct ReadSurface {
  velum::InputFile file;
  velum::Length tolerance{1e-5};

  static auto about() {
    return velum::About<ReadSurface>(
               "Reads one trimmed face of a STEP or IGES file as a B-spline surface")
        .out("surface", "the face, with its borders as trimming loops")
        .param(&ReadSurface::file, "file", "the file; its content decides what it is")
        .required()
        .param(&ReadSurface::tolerance, "tolerance",
               "how closely the trimming loops follow the file's border curves",
               velum::Range{.low = 1e-7, .high = 1e-2})
        .advanced()
        .isolated()
        .reference("ISO 10303-21, -214; IGES 5.3 entities 128, 142 and 144")
        .licence("MIT AND GPL-3.0-or-later AND LGPL-2.1-only WITH OCCT-exception-1.0");
  }

  Surface operator()(Context& context) const {
    Surface surface = velum::cad::read_exchange(file.path, tolerance, context);
    context.measure("control_points", static_cast<double>(surface.control.cols()), "");
    context.measure("loops", static_cast<double>(surface.trimming.size()), "");
    return surface;
  }
};

}  // namespace

VELUM_STAGE(ReadSurface)
