// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A static constructor that throws a std::exception.
#include <stdexcept>

#include "bad_plugins/nothing.hpp"

namespace {

struct AtLoad {
  AtLoad() { throw std::runtime_error("no licence found"); }
};
const AtLoad at_load;

}  // namespace
VELUM_STAGE(Nothing)
