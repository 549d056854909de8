// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/assemble.hpp"

/// LAS 1.0 to 1.4 (ASPRS), point formats 0 to 10, not compressed.
namespace velum::formats {

/// Positions exact to the file's own scale by way of the origin; intensity, classification as
/// label, time and colour where the point format has them.
Cloud read_las(const Source& source, const ReadOptions& options, Context& context);

}  // namespace velum::formats
