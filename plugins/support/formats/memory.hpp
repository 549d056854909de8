// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <memory>

namespace velum::formats {

/// Asks for huge pages for memory that is about to be filled: first touching small ones costs more
/// than filling them.
inline void prefer_huge_pages(void* data, std::size_t size) {
  constexpr std::size_t kHugePage = std::size_t{2} << 20U;
  if (size < 2 * kHugePage || std::align(kHugePage, kHugePage, data, size) == nullptr) return;
  ::madvise(data, size / kHugePage * kHugePage, MADV_HUGEPAGE);
}

/// A block of memory that is not zeroed.
struct Buffer {
  std::unique_ptr<std::byte[]> data;
  std::size_t size = 0;
  explicit Buffer(std::size_t bytes)
      : data(std::make_unique_for_overwrite<std::byte[]>(bytes)), size(bytes) {
    prefer_huge_pages(data.get(), bytes);
  }
};

}  // namespace velum::formats
