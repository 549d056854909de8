// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Reads a number, makes as many points.
#include <charconv>
#include <velum/files.hpp>
#include <velum/stage.hpp>

namespace {

struct Read {
  velum::InputFile file;

  static auto about() {
    return velum::About<Read>("Reads how many points to make.")
        .out("cloud")
        .param(&Read::file, "file", "to read")
        .required();
  }
  velum::Cloud operator()(velum::Context&) const {
    const velum::FileContent content(file.path);
    int count = 0;
    const auto text = content.text();
    if (std::from_chars(text.data(), text.data() + text.size(), count).ec != std::errc())
      throw velum::Error(velum::Fault::input, "found no number, expected how many points")
          .at(file.path.string() + ":1");
    return velum::Cloud(velum::Points::Zero(3, count).eval());
  }
};

}  // namespace
VELUM_STAGE(Read)
