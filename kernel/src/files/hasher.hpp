// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <xxhash.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace velum::files {

/// XXH3-128 of what is fed to it, in order.
class Hasher {
 public:
  Hasher();
  void add(std::span<const std::byte> bytes);
  /// The length, then the text, so that neighbouring texts cannot run into each other.
  void add(std::string_view text);
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void add(T value) {
    add(std::as_bytes(std::span(&value, 1)));
  }
  [[nodiscard]] XXH128_hash_t digest() const;
  /// The digest in lower-case hexadecimal.
  [[nodiscard]] std::string hex() const;

 private:
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> state_;
};

std::string to_hex(const XXH128_hash_t& hash);

}  // namespace velum::files
