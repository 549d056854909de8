// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "formats/transform_io.hpp"

namespace {

using velum::Context;
using velum::Transform;
namespace formats = velum::formats;

struct ReadTransform {
  velum::InputFile file;
  velum::LengthUnit units;
  std::string entry;
  std::optional<std::string> source;
  std::optional<std::string> target;

  static auto about() {
    velum::About<ReadTransform> about("Reads a rigid motion: 16 numbers as text, or JSON");
    about.out("transform", "from the frame `source` to the frame `target`")
        .param(&ReadTransform::file, "file", "the file")
        .required()
        .param(&ReadTransform::units, "units", "unit of the translation where the file names none")
        .param(&ReadTransform::entry, "entry",
               "where the matrix stands in a JSON file, such as /world_from_scan/bun045")
        .param(&ReadTransform::source, "source",
               "name of the frame that it moves from, else the file's")
        .advanced()
        .param(&ReadTransform::target, "target",
               "name of the frame that it moves to, else the file's")
        .advanced();
    return about;
  }

  Transform operator()(Context& context) const {
    context.check();
    Transform transform =
        formats::read_transform(formats::Source(file.path), {units.metres, entry});
    if (source) transform.source = *source;
    if (target) transform.target = *target;
    return transform;
  }
};

}  // namespace

VELUM_STAGE(ReadTransform)
