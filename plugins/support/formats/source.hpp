// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "velum/error.hpp"
#include "velum/files.hpp"

namespace velum::formats {

/// The content of one input file, and how to name a place in it.
class Source {
 public:
  /// Reads the file; throws Error (Fault::input) when it cannot be read or is empty.
  explicit Source(const std::filesystem::path& path);
  /// Content that lies in memory and stays there.
  Source(std::string name, std::span<const std::byte> bytes);
  Source(std::string name, std::string_view text);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  [[nodiscard]] std::string_view text() const {
    return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()};  // NOLINT
  }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  /// The extension of the name in lower case, with its dot; "" when there is none.
  [[nodiscard]] std::string extension() const;

  /// An error about the content at `offset`, by line ("scan.pcd:12") or by byte.
  [[nodiscard]] Error bad_line(std::size_t offset, const std::string& message) const;
  [[nodiscard]] Error bad_byte(std::size_t offset, const std::string& message) const;
  /// The same for a piece of text().
  [[nodiscard]] Error bad_line(std::string_view piece, const std::string& message) const;

  /// Throws when anything but blanks, line ends and zeros follows `end`, where the data should end.
  void require_end(std::size_t end) const;

  /// Frees the content of a file that has been read in full: nothing of it may be used any more.
  void release();

 private:
  void require_content() const;

  std::string name_;
  std::optional<FileContent> content_;
  std::span<const std::byte> bytes_;
};

/// `text` for a message: in quotes, cut after 40 characters, unprintable characters as '?'.
std::string quote(std::string_view text);

}  // namespace velum::formats
