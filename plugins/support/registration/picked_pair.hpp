// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "velum/parameter.hpp"

namespace velum::registration {

/// Two points given by the user: the same place, or places on the same plane, as each cloud has it.
struct PickedPair {
  Place source;
  Place target;
};

}  // namespace velum::registration
