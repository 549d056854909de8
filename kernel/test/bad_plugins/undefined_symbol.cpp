// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Linked without the library that it calls.
#include "bad_plugins/nothing.hpp"

int found_nowhere();

namespace {

const int at_load = found_nowhere();

}  // namespace
VELUM_STAGE(Nothing)
