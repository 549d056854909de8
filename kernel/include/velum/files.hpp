// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "velum/error.hpp"

namespace velum {

/// The whole content of a file. Throws Error (Fault::input) naming the file and the reason when it
/// cannot be read, is not a regular file, or is larger than `limit` bytes.
class VELUM_API FileContent {
 public:
  explicit FileContent(const std::filesystem::path& path,
                       std::uint64_t limit = std::uint64_t{1} << 40U);
  [[nodiscard]] std::span<const std::byte> bytes() const { return {data_.get(), size_}; }
  [[nodiscard]] std::string_view text() const {
    return {reinterpret_cast<const char*>(data_.get()), size_};  // NOLINT
  }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  std::unique_ptr<std::byte[]> data_;
  std::size_t size_ = 0;
};

/// Writes a file so that its final name only ever holds the whole of it: written aside in the same
/// folder, flushed to the disk, read back and compared, then renamed. The destructor removes what
/// was not committed. All failures throw Error (Fault::output) naming the file and the reason; a
/// target that exists and is not a regular file is refused.
class VELUM_API AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::span<const std::byte> bytes);
  void write(std::string_view text);
  /// Where the content is until commit(), for libraries that write files themselves: call
  /// adopt() when such a library is done.
  [[nodiscard]] const std::filesystem::path& aside() const;
  void adopt();
  /// Flushes, reads back (the length and, for written content, its checksum), then renames.
  void commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes `text` to `target` by way of AtomicFile.
VELUM_API void write_file(const std::filesystem::path& target, std::string_view text);
/// XXH3-128 in lower-case hexadecimal.
VELUM_API std::string hash_of(std::span<const std::byte> bytes);

}  // namespace velum
