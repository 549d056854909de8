// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <velum/testing.hpp>

#include "formats/test_tools.hpp"
#include "velum/files.hpp"

/// What the tests of stages that read and write files share.
namespace velum::formats::test {

/// A file with this content.
inline std::filesystem::path put(const Folder& folder, const std::string& name,
                                 std::string_view text) {
  write_file(folder / name, text);
  return folder / name;
}

inline std::string text_of(const std::filesystem::path& file) {
  return std::string(FileContent(file).text());
}

/// The stage with its parameter `file`.
inline velum::test::Stage stage_on(const std::string& id, const std::filesystem::path& file) {
  velum::test::Stage made(id);
  made.set("file", file.string());
  return made;
}

/// How reading ends that must fail, with the place named.
inline Fault fault_of(velum::test::Stage made) {
  try {
    (void)made.run();
  } catch (const Error& error) {
    CHECK_FALSE(error.where().empty());
    return error.fault();
  }
  return Fault::device;
}

}  // namespace velum::formats::test
