// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lms511/record.hpp"

/// The .vrec file: docs/vrec.md is its definition.
namespace velum::lms511 {

/// Appends records to a file in blocks that are compressed and checksummed one by one, so that a
/// kill or a full disk costs the block that was being filled and nothing else. Throws Error
/// (Fault::output) naming the file.
class VrecWriter {
 public:
  struct Options {
    /// A new part (name.0001.vrec, ...) begins when one is larger [bytes]; 0: never.
    std::uint64_t rotate = 0;
    /// A block is written when it spans this much time [ns] ...
    std::int64_t block_time = 200'000'000;
    /// ... or holds this much [bytes], before compression.
    std::size_t block_size = std::size_t{256} << 10U;
  };

  VrecWriter(std::filesystem::path path, Options options);
  /// Writes what is held, as far as it can.
  ~VrecWriter();
  VrecWriter(const VrecWriter&) = delete;
  VrecWriter& operator=(const VrecWriter&) = delete;

  void add(const Record& record);
  /// Writes the block that is being filled.
  void flush();
  /// Writes all and flushes it to the disk; nothing may be added afterwards.
  void close();

  /// Bytes written so far, in all parts.
  [[nodiscard]] std::uint64_t written() const;
  [[nodiscard]] std::uint64_t records() const;
  /// The files of this recording, the first one first.
  [[nodiscard]] const std::vector<std::filesystem::path>& parts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reads records one after the other. What is damaged is skipped to the next whole block and
/// reported.
class VrecReader {
 public:
  /// Throws Error (Fault::input) at `name` when the bytes do not begin as a recording, or are of a
  /// version that is not known. The bytes must outlive the reader.
  VrecReader(std::span<const std::byte> bytes, std::string name);
  ~VrecReader();
  VrecReader(VrecReader&&) noexcept;
  VrecReader& operator=(VrecReader&&) = delete;

  /// False at the end.
  [[nodiscard]] bool next(Record& record);
  /// Bytes that belong to no whole block: damage, or the block that a kill cut off.
  [[nodiscard]] std::uint64_t damaged_bytes() const;
  /// Blocks that are missing between others.
  [[nodiscard]] std::uint64_t missing_blocks() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Does the content begin as a recording does?
[[nodiscard]] bool is_vrec(std::span<const std::byte> bytes);
/// The parts of the recording whose first file is `path`, in order.
[[nodiscard]] std::vector<std::filesystem::path> parts_of(const std::filesystem::path& path);

}  // namespace velum::lms511
