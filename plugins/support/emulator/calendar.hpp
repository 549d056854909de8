// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lms511/scan.hpp"

namespace velum::emulator {

/// Seconds since 1970 as the device writes them, and back. The device knows no leap seconds.
[[nodiscard]] lms511::Moment moment_of(double seconds);
[[nodiscard]] double seconds_of(const lms511::Moment& moment);

/// u16 year, u8 month, day, hour, minute, second, u32 microsecond.
void write_moment(lms511::Writer& answer, const lms511::Moment& moment);

}  // namespace velum::emulator
