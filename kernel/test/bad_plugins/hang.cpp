// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A static constructor that never ends.
#include <unistd.h>

#include "bad_plugins/nothing.hpp"

namespace {

struct AtLoad {
  AtLoad() {
    while (true) ::pause();
  }
};
const AtLoad at_load;

}  // namespace
VELUM_STAGE(Nothing)
