// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace velum::flat {

/// A blob's size and checksum; its place follows from the sizes of those before it.
struct Blob {
  std::uint64_t size;
  std::uint64_t low, high;
};

/// First 64 bytes of a flat file. The index follows: `blobs` entries of Blob, then the results.
struct Header {
  std::array<char, 8> magic = {'V', 'E', 'L', 'U', 'M', 'F', 'L', 'T'};
  std::uint32_t version = 1;
  std::uint32_t byte_order = 0x01020304;
  std::uint64_t file_size = 0;
  std::uint64_t index_size = 0;
  std::uint64_t blobs = 0;
  std::uint64_t index_low = 0;
  std::uint64_t index_high = 0;
  std::uint64_t check = 0;  ///< XXH3-64 of all before it
};
static_assert(sizeof(Header) == 64 && sizeof(Blob) == 24);

constexpr std::uint64_t kAlignment = 64;
constexpr std::uint64_t aligned(std::uint64_t offset) {
  return (offset + kAlignment - 1) / kAlignment * kAlignment;
}

}  // namespace velum::flat
