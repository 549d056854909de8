// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "file_kind.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <sstream>
#include <vector>

#include "files/descriptor.hpp"
#include "velum/error.hpp"

namespace velum::app {
namespace {

namespace fs = std::filesystem;

constexpr std::array kClouds = {".pcd", ".xyz", ".txt", ".csv", ".tsv", ".asc",
                                ".pts", ".las", ".3d",  ".ply", ".vtk"};
constexpr std::array kMeshes = {".ply", ".stl", ".obj", ".off", ".vtk"};
constexpr std::array kTransforms = {".json", ".txt"};
constexpr const char* kKnown =
    "known: pcd, ply, las and vrec (both read only), xyz, txt, csv, vtk for clouds; ply, stl, obj, "
    "off, vtk for "
    "meshes; json, txt for transforms";

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

bool has_faces(const std::string& extension, const std::string& text) {
  if (extension == ".vtk") return text.find("POLYGONS") != std::string::npos;
  const std::size_t at = text.find("element face ");
  return at != std::string::npos && text.compare(at, 14, "element face 0") != 0;
}

// Four rows of four numbers, the last one 0 0 0 1.
bool is_matrix(const std::string& text) {
  std::istringstream words(text);
  std::vector<std::string> numbers;
  for (std::string word; words >> word && numbers.size() < 17;)
    if (!word.starts_with("#")) numbers.push_back(word);
  if (numbers.size() != 16) return false;
  for (std::size_t i = 12; i < 16; ++i) {
    double number = -1.0;
    std::from_chars(numbers[i].data(), numbers[i].data() + numbers[i].size(), number);
    if (number != (i == 15 ? 1.0 : 0.0)) return false;
  }
  return true;
}

[[noreturn]] void unknown(const fs::path& path) {
  throw Error(Fault::graph, fmt::format("'{}' is no format that is known", extension_of(path)))
      .at(path.string())
      .hint(kKnown);
}

}  // namespace

FileKind kind_of_input(const fs::path& path) {
  const std::string extension = extension_of(path);
  const std::string text = beginning_of(path);
  if (text.starts_with("VELUMREC")) return FileKind::recording;
  if (extension == ".ply" || extension == ".vtk")
    return has_faces(extension, text) ? FileKind::mesh : FileKind::cloud;
  if (extension == ".json") return FileKind::transform;
  if (extension == ".txt" && is_matrix(text)) return FileKind::transform;
  if (is_one_of(extension, kClouds)) return FileKind::cloud;
  if (is_one_of(extension, kMeshes)) return FileKind::mesh;
  unknown(path);
}

FileKind kind_of_output(const fs::path& path, FileKind input) {
  if (input == FileKind::recording) input = FileKind::cloud;  // that is what it becomes
  const std::string extension = extension_of(path);
  const bool cloud = is_one_of(extension, kClouds) && extension != ".las";
  const bool mesh = is_one_of(extension, kMeshes);
  const bool transform = is_one_of(extension, kTransforms);
  if (input == FileKind::transform && transform) return input;
  if (input == FileKind::mesh && mesh) return input;
  if (input != FileKind::transform && cloud) return FileKind::cloud;
  if (!cloud && !mesh && !transform) unknown(path);
  throw Error(Fault::graph, fmt::format("a {} cannot be written as '{}'",
                                        input == FileKind::cloud  ? "cloud"
                                        : input == FileKind::mesh ? "mesh"
                                                                  : "transform",
                                        extension))
      .at(path.string())
      .hint(kKnown);
}

std::string reader_of(FileKind kind) {
  if (kind == FileKind::cloud) return "io.read_cloud";
  if (kind == FileKind::recording) return "devices.replay";
  return kind == FileKind::mesh ? "io.read_mesh" : "io.read_transform";
}

std::string writer_of(FileKind kind) {
  if (kind == FileKind::cloud) return "io.write_cloud";
  return kind == FileKind::mesh ? "io.write_mesh" : "io.write_transform";
}

}  // namespace velum::app
