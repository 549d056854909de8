// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Writes how many points there are.
#include <string>
#include <velum/files.hpp>
#include <velum/stage.hpp>

namespace {

struct Write {
  velum::OutputFile file;
  int times = 1;

  static auto about() {
    return velum::About<Write>("Writes the number of points.")
        .in("cloud")
        .param(&Write::file, "file", "to write")
        .required()
        .param(&Write::times, "times", "that it is written", velum::at_least(1));
  }
  void operator()(const velum::Cloud& cloud, velum::Context&) const {
    velum::AtomicFile output(file.path);
    for (int i = 0; i < times; ++i) output.write(std::to_string(cloud.size()) + "\n");
    output.commit();
  }
};

}  // namespace
VELUM_STAGE(Write)
