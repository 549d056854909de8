// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// about() throws while the stage is made.
#include <stdexcept>
#include <velum/stage.hpp>

namespace {

struct Thrower {
  static velum::About<Thrower> about() { throw std::logic_error("two ports, one name"); }
  velum::Table operator()(velum::Context&) const { return {}; }
};

}  // namespace
VELUM_STAGE(Thrower)
