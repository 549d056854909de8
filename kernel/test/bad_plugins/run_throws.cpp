// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Throws while it runs, whatever the graph asks for.
#include <new>
#include <stdexcept>
#include <velum/stage.hpp>

namespace {

enum class What { standard, own_standard, own, integer, memory, kernel, cancelled };

struct OwnError : std::runtime_error {
  OwnError() : std::runtime_error("own error of the plugin") {}
};
struct Own {};

struct RunThrows {
  What what = What::standard;

  static auto about() {
    return velum::About<RunThrows>("Throws.").out("table").choice(
        &RunThrows::what, "what", "the kind of exception",
        {{"standard", What::standard, "std::runtime_error"},
         {"own_standard", What::own_standard, "a type of the plugin, derived from std::exception"},
         {"own", What::own, "a type of the plugin, derived from nothing"},
         {"integer", What::integer, "an int"},
         {"memory", What::memory, "std::bad_alloc"},
         {"kernel", What::kernel, "velum::Error"},
         {"cancelled", What::cancelled, "velum::Cancelled"}});
  }

  velum::Table operator()(velum::Context&) const {
    switch (what) {
      case What::standard:
        throw std::runtime_error("a vector too long");
      case What::own_standard:
        throw OwnError();
      case What::own:
        throw Own();
      case What::integer:
        throw 42;  // NOLINT(hicpp-exception-baseclass)
      case What::memory:
        throw std::bad_alloc();
      case What::kernel:
        throw velum::Error(velum::Fault::device, "no echo").at("COM1").hint("plug it in");
      case What::cancelled:
        throw velum::Cancelled();
    }
    return {};
  }
};

}  // namespace
VELUM_STAGE(RunThrows)
