// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/source.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace velum::formats {

Source::Source(const std::filesystem::path& path) : name_(path.string()), content_(path) {
  bytes_ = content_->bytes();
  require_content();
}

Source::Source(std::string name, std::span<const std::byte> bytes)
    : name_(std::move(name)), bytes_(bytes) {
  require_content();
}

Source::Source(std::string name, std::string_view text)
    : Source(std::move(name), std::as_bytes(std::span(text))) {}

void Source::require_content() const {
  if (bytes_.empty()) throw Error(Fault::input, "the file is empty (0 bytes)").at(name_);
}

std::string Source::extension() const {
  std::string extension = std::filesystem::path(name_).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return extension;
}

Error Source::bad_line(std::size_t offset, const std::string& message) const {
  const std::string_view before = text().substr(0, std::min(offset, size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  return Error(Fault::input, message).at(fmt::format("{}:{}", name_, line));
}

Error Source::bad_byte(std::size_t offset, const std::string& message) const {
  return Error(Fault::input, message).at(fmt::format("{}: byte {}", name_, offset));
}

Error Source::bad_line(std::string_view piece, const std::string& message) const {
  return bad_line(static_cast<std::size_t>(piece.data() - text().data()), message);
}

void Source::require_end(std::size_t end) const {
  const std::size_t more = text().find_first_not_of(std::string_view("\0\n\r\t ", 5), end);
  if (more != std::string_view::npos)
    throw bad_byte(more, fmt::format("{} bytes follow where the data should end", size() - end));
}

void Source::release() {
  if (!content_) return;
  bytes_ = {};
  content_.reset();
}

std::string quote(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string result = "'";
  for (const char c : text.substr(0, kLongest)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > kLongest ? "...'" : "'");
}

}  // namespace velum::formats
