// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A static constructor that ends the process as an invalid access would.
#include <csignal>

#include "bad_plugins/nothing.hpp"

namespace {

struct AtLoad {
  AtLoad() { std::raise(SIGSEGV); }
};
const AtLoad at_load;

}  // namespace
VELUM_STAGE(Nothing)
