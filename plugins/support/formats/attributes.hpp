// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "formats/records.hpp"
#include "velum/context.hpp"

namespace velum::formats {

/// Columns of a cloud from the fields that are not its positions: normals, colour, intensity, ...
/// by the names that files use for them, any other field as an extra column of its natural type.
/// `used` are names (in lower case) to leave out. With `left_handed`, normals turn as positions do.
Columns read_attributes(const Records& records, const Kept& kept, std::span<const std::string> used,
                        bool left_handed, Context& context);

}  // namespace velum::formats
