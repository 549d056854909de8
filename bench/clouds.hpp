// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/cloud.hpp>

namespace bench {

/// A sail of 7 m luff and 3 m foot, 10 % camber, 15° twist: `count` random points with 4 mm noise
/// along the ray from a sensor 6 m away, in random order.
velum::Cloud sail(velum::Index count);

/// The same sail turned by 2° and moved by 30 mm, other random points: a pair to register.
velum::Cloud sail_moved(velum::Index count);

}  // namespace bench
