// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "files/hasher.hpp"

namespace velum::report {

/// An immutable array for the page, shared by all its copies and known by its content.
class Bytes {
 public:
  /// 128 bits of its content; zero for no array at all.
  using Key = std::pair<std::uint64_t, std::uint64_t>;

  Bytes() = default;
  explicit Bytes(std::vector<std::byte> bytes)
      : data_(std::make_shared<const std::vector<std::byte>>(std::move(bytes))) {
    files::Hasher hasher;
    hasher.add(std::span<const std::byte>(*data_));
    const XXH128_hash_t digest = hasher.digest();
    key_ = {digest.high64, digest.low64};
  }
  template <class T>
  static Bytes of(const std::vector<T>& numbers) {
    static_assert(std::is_arithmetic_v<T>);
    const auto bytes = std::as_bytes(std::span(numbers));
    return Bytes(std::vector<std::byte>(bytes.begin(), bytes.end()));
  }

  [[nodiscard]] bool there() const { return data_ != nullptr; }
  [[nodiscard]] std::size_t size() const { return data_ == nullptr ? 0 : data_->size(); }
  [[nodiscard]] const Key& key() const { return key_; }
  [[nodiscard]] std::span<const std::byte> bytes() const {
    return data_ == nullptr ? std::span<const std::byte>() : std::span<const std::byte>(*data_);
  }
  /// The numbers in it; they were put in as T.
  template <class T>
  [[nodiscard]] std::span<const T> as() const {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): vectors are aligned for any T
    return {reinterpret_cast<const T*>(bytes().data()), size() / sizeof(T)};
  }

 private:
  std::shared_ptr<const std::vector<std::byte>> data_;
  Key key_;
};

}  // namespace velum::report
