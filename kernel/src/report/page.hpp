// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "run/json.hpp"

namespace velum::report {

/// The page that is built from web/, into which the data go: one file, all inlined.
class Page {
 public:
  /// The one that belongs to this libvelum, in the build tree or installed, or the one that
  /// VELUM_REPORT_TEMPLATE names. Throws Error (Fault::output) when there is none.
  Page();
  /// A page that is given; throws Error (Fault::output) when it has no place for the data.
  explicit Page(std::string text, const std::string& name);

  [[nodiscard]] std::size_t size() const { return text_.size(); }
  /// The page with its data: `json` is escaped, `block` becomes base64. Atomically; throws Error
  /// (Fault::output).
  void write(const std::filesystem::path& file, const run::Json& json,
             std::span<const std::byte> block) const;

 private:
  std::string text_;
  std::size_t mark_ = 0;
};

/// The line of the page that the data take the place of.
inline constexpr std::string_view kMark = "<!-- velum:data -->";

/// JSON that can stand in a script element: nothing in it can end the element.
[[nodiscard]] std::string script_json(const run::Json& json);
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

/// Files of share/velum/ of this installation or build tree; empty when it is not there.
[[nodiscard]] std::filesystem::path shared_file(std::string_view name);

}  // namespace velum::report
