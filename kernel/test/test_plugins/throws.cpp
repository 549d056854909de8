// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Throws what it is told to.
#include <new>
#include <stdexcept>
#include <velum/stage.hpp>

namespace {

enum class What { error, input, device, standard, own, integer, memory };
struct Own {};

struct Throws {
  What what = What::error;

  static auto about() {
    return velum::About<Throws>("Throws.").in("cloud").out("cloud").choice(
        &Throws::what, "what", "is thrown",
        {{"error", What::error, "velum::Error"},
         {"input", What::input, "velum::Error for bad data"},
         {"device", What::device, "velum::Error for a device"},
         {"standard", What::standard, "std::runtime_error"},
         {"own", What::own, "a type of its own"},
         {"integer", What::integer, "42"},
         {"memory", What::memory, "std::bad_alloc"}});
  }
  velum::Cloud operator()(const velum::Cloud&, velum::Context& context) const {
    using velum::Error;
    using velum::Fault;
    context.info("about to throw");
    switch (what) {
      case What::error:
        throw Error(Fault::stage, "three points are too few").hint("take more");
      case What::input:
        throw Error(Fault::input, "found 3 columns, expected 4").at("scan.txt:12");
      case What::device:
        throw Error(Fault::device, "no answer within 5 s").at("tcp://scanner:2111");
      case What::standard:
        throw std::runtime_error("matrix is singular");
      case What::own:
        throw Own();
      case What::integer:
        throw 42;
      case What::memory:
        throw std::bad_alloc();
    }
    throw std::logic_error("no such case");
  }
};

}  // namespace
VELUM_STAGE(Throws)
