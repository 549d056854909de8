// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "files/hasher.hpp"

#include <fmt/format.h>

#include <new>

#include "velum/files.hpp"

namespace velum::files {

Hasher::Hasher() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_128bits_reset(state_.get());
}

void Hasher::add(std::span<const std::byte> bytes) {
  if (!bytes.empty()) XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
}

void Hasher::add(std::string_view text) {
  add(std::uint64_t{text.size()});
  add(std::as_bytes(std::span(text)));
}

XXH128_hash_t Hasher::digest() const {
  return XXH3_128bits_digest(state_.get());
}

std::string Hasher::hex() const {
  return to_hex(digest());
}

std::string to_hex(const XXH128_hash_t& hash) {
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace velum::files

namespace velum {

std::string hash_of(std::span<const std::byte> bytes) {
  return files::to_hex(XXH3_128bits(bytes.data(), bytes.size()));
}

}  // namespace velum
