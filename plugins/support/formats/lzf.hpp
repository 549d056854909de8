// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace velum::formats {

/// Unpacks LZF data (M. Lehmann's format, used by PCD) into exactly `out`; false when the data is
/// damaged or of another length.
bool lzf_unpack(std::span<const std::byte> in, std::span<std::byte> out);

/// Packs in the same format; incompressible input grows by at most 1/32.
std::vector<std::byte> lzf_pack(std::span<const std::byte> in);

/// No LZF data unpacks to more than this many times its length: three bytes give at most 264.
inline constexpr std::size_t kLzfMostRatio = 88;

}  // namespace velum::formats
