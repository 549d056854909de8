// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A static constructor that throws what is not a std::exception.
#include "bad_plugins/nothing.hpp"

namespace {

struct AtLoad {
  AtLoad() { throw 42; }
};
const AtLoad at_load;

}  // namespace
VELUM_STAGE(Nothing)
