// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "formats/transform_io.hpp"

namespace {

using velum::Context;
using velum::Transform;
using velum::formats::TransformFormat;

struct WriteTransform {
  velum::OutputFile file;
  velum::LengthUnit units;
  TransformFormat format = TransformFormat::automatic;

  static auto about() {
    velum::About<WriteTransform> about(
        "Writes a rigid motion as 4x4 text or JSON, with 17 digits and both frames named");
    about.in("transform", "what to write")
        .param(&WriteTransform::file, "file", "the file to write")
        .required()
        .param(&WriteTransform::units, "units", "unit of the translation, which the file names")
        .choice(&WriteTransform::format, "format", "how to write it",
                {{"auto", TransformFormat::automatic, "JSON for .json, text otherwise"},
                 {"text", TransformFormat::text, "four rows of four numbers under comments"},
                 {"json", TransformFormat::json, "an object with source, target, unit, matrix"}});
    return about;
  }

  void operator()(const Transform& transform, Context& context) const {
    context.check();
    velum::formats::write_transform(file.path, transform, format, units);
  }
};

}  // namespace

VELUM_STAGE(WriteTransform)
