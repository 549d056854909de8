// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A static constructor that ends the process.
#include <cstdlib>

#include "bad_plugins/nothing.hpp"

namespace {

struct AtLoad {
  AtLoad() { std::_Exit(3); }
};
const AtLoad at_load;

}  // namespace
VELUM_STAGE(Nothing)
