// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <velum/cloud.hpp>
#include <velum/testing.hpp>

namespace bench {

/// A sail of 7 m luff and 3 m foot, 10 % camber, 15° twist: `count` random points with 4 mm noise
/// along the ray from a sensor 6 m away, in random order.
velum::Cloud sail(velum::Index count);

/// The same sail turned by 2° and moved by 30 mm, other random points: a pair to register.
velum::Cloud sail_moved(velum::Index count);

/// The simulated scanner "mainsail" or "gennaker" of the wind tunnel, for about `count` points.
velum::test::Stage scanner(const std::string& name, velum::Index count);

/// LAS 1.2, point format 0, steps of 0.1 mm.
void write_las(const std::string& file, const velum::Cloud& cloud);

/// What an LMS 511 sends at 25 Hz and 1/6 degree, back to back, for about `count` returns: CoLa A
/// in `folder`/lines_a.bin, CoLa B in lines_b.bin, a recording of CoLa B in lines.vrec.
void write_lines(const std::string& folder, velum::Index count);

}  // namespace bench
