// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "file_kind.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "file_content.hpp"
#include "files/descriptor.hpp"
#include "velum/error.hpp"

namespace velum::app {
namespace {

namespace fs = std::filesystem;

constexpr std::array kClouds = {".pcd", ".xyz", ".txt", ".csv", ".tsv", ".asc",
                                ".pts", ".las", ".3d",  ".ply", ".vtk"};
constexpr std::array kMeshes = {".ply", ".stl", ".obj", ".off", ".vtk", ".glb"};
constexpr std::array kSurfaces = {".step", ".stp", ".iges", ".igs"};
constexpr std::array kTransforms = {".json", ".txt"};
constexpr const char* kKnown =
    "known: pcd, ply, las and vrec (both read only), xyz, txt, csv, vtk for clouds; ply, stl, obj, "
    "off, vtk, glb "
    "for meshes; step, iges for surfaces; json, txt for transforms";

std::string extension_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return extension;
}

template <std::size_t N>
bool is_one_of(const std::string& extension, const std::array<const char*, N>& list) {
  return std::find(list.begin(), list.end(), extension) != list.end();
}

std::string beginning_of(const fs::path& path) {
  std::error_code failed;
  if (!fs::is_regular_file(path, failed))
    throw Error(Fault::graph, fs::exists(path, failed) ? "not a regular file" : "no such file")
        .at(path.string());
  const files::Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file) throw Error(Fault::graph, "the file cannot be opened").at(path.string());
  std::string text(65536, '\0');
  text.resize(files::read_fully(file.get(), std::as_writable_bytes(std::span(text))));
  return text;
}

[[noreturn]] void unknown(const fs::path& path, const std::string& content) {
  const std::string extension = extension_of(path);
  throw Error(Fault::graph,
              (extension.empty() ? "the name has no ending that tells a format"
                                 : fmt::format("'{}' is no format that is known", extension)) +
                  content)
      .at(path.string())
      .hint(kKnown);
}

const char* name_of(FileKind kind) {
  switch (kind) {
    case FileKind::cloud:
      return "cloud";
    case FileKind::mesh:
      return "mesh";
    case FileKind::surface:
      return "surface";
    case FileKind::transform:
      return "transform";
    case FileKind::recording:
      break;
  }
  return "recording";
}

}  // namespace

FileKind kind_of_input(const fs::path& path) {
  const std::string extension = extension_of(path);
  const std::string text = beginning_of(path);
  std::error_code failed;
  if (const auto kind = kind_by_content(text, fs::file_size(path, failed))) return *kind;
  if (extension == ".json") return FileKind::transform;
  if (is_one_of(extension, kSurfaces)) return FileKind::surface;
  const bool numbers = begins_with_numbers(text);
  const bool named = is_one_of(extension, kClouds) || is_one_of(extension, kMeshes);
  if ((extension == ".txt" || !named) && is_matrix(text)) return FileKind::transform;
  if (is_one_of(extension, kClouds) || (!named && numbers)) return FileKind::cloud;
  if (named) return FileKind::mesh;
  unknown(path, ", and its content is none");
}

FileKind kind_of_output(const fs::path& path, FileKind input) {
  if (input == FileKind::recording) input = FileKind::cloud;  // that is what it becomes
  const std::string extension = extension_of(path);
  const bool cloud = is_one_of(extension, kClouds);
  const bool mesh = is_one_of(extension, kMeshes);
  const bool surface = is_one_of(extension, kSurfaces);
  const bool transform = is_one_of(extension, kTransforms);
  if (!cloud && !mesh && !surface && !transform) unknown(path, "");
  if (extension == ".las")
    throw Error(Fault::graph, "LAS can only be read").at(path.string()).hint(kKnown);
  if (input == FileKind::transform && transform) return input;
  // A surface is written as itself or as its triangles.
  if (input == FileKind::surface && (surface || mesh)) return input;
  if (input == FileKind::mesh && mesh) return input;
  if ((input == FileKind::cloud || input == FileKind::mesh) && cloud) return FileKind::cloud;
  throw Error(Fault::graph,
              fmt::format("a {} cannot be written as '{}'", name_of(input), extension))
      .at(path.string())
      .hint(kKnown);
}

std::string reader_of(FileKind kind) {
  if (kind == FileKind::recording) return "devices.replay";
  return std::string("io.read_") + name_of(kind);
}

std::string writer_of(FileKind kind) {
  return std::string("io.write_") + name_of(kind);
}

}  // namespace velum::app
