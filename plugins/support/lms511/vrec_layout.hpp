// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#define XXH_INLINE_ALL
#include <xxhash.h>

/// Numbers of the .vrec file, little-endian, as docs/vrec.md defines them.
namespace velum::lms511::vrec {

static_assert(std::endian::native == std::endian::little);

inline constexpr std::string_view kMagic = "VELUMREC";
inline constexpr std::uint32_t kVersion = 1;
inline constexpr std::size_t kFileHead = 16;
inline constexpr std::uint32_t kBlockMark = 0x4D524656;  // "VFRM"
inline constexpr std::uint32_t kLargestBlock = std::uint32_t{4} << 20U;
inline constexpr std::size_t kRecordHead = 16;

struct BlockHead {
  std::uint32_t mark = kBlockMark;
  std::uint32_t number = 0;  ///< within the file, from 0
  std::uint32_t raw = 0;     ///< bytes of its records
  std::uint32_t stored = 0;  ///< bytes of its zstd frame, which follows
  std::uint64_t checksum = 0;
};
static_assert(sizeof(BlockHead) == 24);

inline std::uint64_t checksum(const BlockHead& head, std::string_view stored) {
  constexpr std::size_t kCovered = 16;
  return XXH3_64bits_withSeed(stored.data(), stored.size(), XXH3_64bits(&head, kCovered));
}

/// name.vrec, name.0001.vrec, name.0002.vrec, ...
inline std::filesystem::path part_path(const std::filesystem::path& first, unsigned part) {
  if (part == 0) return first;
  std::string number = std::to_string(part);
  number.insert(0, number.size() < 4 ? 4 - number.size() : 0, '0');
  std::filesystem::path path = first;
  return path.replace_filename(first.stem().string() + "." + number + first.extension().string());
}

}  // namespace velum::lms511::vrec
