// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>

namespace velum::files {

/// Owner of a file descriptor; false when it holds none.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor();

  [[nodiscard]] int get() const { return descriptor_; }
  explicit operator bool() const { return descriptor_ >= 0; }

 private:
  int descriptor_ = -1;
};

/// What the system says of error number `error`.
std::string reason(int error);
/// Reads until `to` is full or the file ends; returns the bytes read. Throws std::system_error.
std::size_t read_fully(int descriptor, std::span<std::byte> to);
/// Writes all of `from`; throws std::system_error.
void write_fully(int descriptor, std::span<const std::byte> from);

}  // namespace velum::files
