// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A stage that does nothing: the plugin that the others are spoiled copies of.
#include <velum/stage.hpp>

namespace {

struct Sound {
  velum::Length size = 0.5;
  bool fail = false;

  static auto about() {
    return velum::About<Sound>("Gives its cloud back.")
        .in("cloud")
        .out("cloud")
        .param(&Sound::size, "size", "of no consequence", velum::above(0.0))
        .param(&Sound::fail, "fail", "throws an error of the kernel's own type");
  }

  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    context.measure("size", size, "m");
    if (fail) throw velum::Error(velum::Fault::input, "asked to fail").at("here:1");
    return cloud;
  }
};

}  // namespace
VELUM_STAGE(Sound)
