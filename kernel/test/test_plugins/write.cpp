// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Writes how many points there are.
#include <string>
#include <velum/files.hpp>
#include <velum/stage.hpp>

namespace {

struct Write {
  velum::OutputFile file;

  static auto about() {
    return velum::About<Write>("Writes the number of points.")
        .in("cloud")
        .param(&Write::file, "file", "to write")
        .required();
  }
  void operator()(const velum::Cloud& cloud, velum::Context&) const {
    velum::write_file(file.path, std::to_string(cloud.size()) + "\n");
  }
};

}  // namespace
VELUM_STAGE(Write)
