// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "plugins/entry.hpp"

#include <fmt/format.h>

#include <cstring>
#include <string>

#include "plugins/elf.hpp"
#include "velum/error.hpp"

namespace velum::plugins {
namespace {

constexpr const char* kRebuild = "build the plugin again with the SDK of this Velum";
constexpr const char* kCompiler = "build the plugin with the compiler that built Velum";
constexpr const char* kEigen = "build the plugin with the Eigen and the options of Velum's SDK";
constexpr const char* kFlags = "build the plugin with the options that velum_add_plugin sets";

std::string number(std::uint32_t value) {
  return fmt::format("{}", value);
}
std::string compiler(std::uint32_t value) {
  return value == 1 ? "GCC" : value == 2 ? "clang" : number(value);
}
std::string yes_no(std::uint32_t value) {
  return value == 0 ? "off" : value == 1 ? "on" : number(value);
}
std::string eigen(std::uint32_t value) {
  return fmt::format("{}.{}.{}", value / 10000, value / 100 % 100, value % 100);
}

struct Field {
  const char* name;
  std::uint32_t Fingerprint::*member;
  std::string (*show)(std::uint32_t);
  const char* hint;
};

constexpr Field kFields[] = {
    {"sdk_major", &Fingerprint::sdk_major, number, kRebuild},
    {"sdk_minor", &Fingerprint::sdk_minor, number, kRebuild},
    {"compiler", &Fingerprint::compiler, compiler, kCompiler},
    {"compiler_major", &Fingerprint::compiler_major, number, kCompiler},
    {"cplusplus", &Fingerprint::cplusplus, number, kFlags},
    {"cxx11_abi", &Fingerprint::cxx11_abi, yes_no, kFlags},
    {"debug_containers", &Fingerprint::debug_containers, yes_no, kFlags},
    {"eigen_version", &Fingerprint::eigen_version, eigen, kEigen},
    {"eigen_alignment", &Fingerprint::eigen_alignment, number, kEigen},
    {"size_of_cloud", &Fingerprint::size_of_cloud, number, kRebuild},
    {"size_of_mesh", &Fingerprint::size_of_mesh, number, kRebuild},
    {"size_of_surface", &Fingerprint::size_of_surface, number, kRebuild},
    {"size_of_transform", &Fingerprint::size_of_transform, number, kRebuild},
    {"size_of_clusters", &Fingerprint::size_of_clusters, number, kRebuild},
    {"size_of_table", &Fingerprint::size_of_table, number, kRebuild},
    {"size_of_stage_info", &Fingerprint::size_of_stage_info, number, kRebuild},
};
static_assert(std::size(kFields) * sizeof(std::uint32_t) == sizeof(Fingerprint),
              "every field of the fingerprint is compared");

}  // namespace

void check_fingerprint(const Fingerprint& plugin, const std::filesystem::path& file) {
  const Fingerprint ours;
  for (const Field& field : kFields) {
    if (plugin.*field.member == ours.*field.member) continue;
    throw Error(Fault::plugin,
                fmt::format("the plugin was built with {} = {}, this Velum with {}", field.name,
                            field.show(plugin.*field.member), field.show(ours.*field.member)))
        .at(file.string())
        .hint(field.hint);
  }
}

void check_entry(const std::filesystem::path& file, std::string_view id) {
  const auto bytes = read_section(file, ".velum", sizeof(PluginEntry));
  PluginEntry entry;
  const PluginEntry expected;
  if (bytes.size() != sizeof(entry) ||
      std::memcmp(bytes.data(), expected.magic, sizeof(expected.magic)) != 0) {
    throw Error(Fault::plugin, "the file's section .velum is not the entry of a plugin of this SDK")
        .at(file.string())
        .hint(kRebuild);
  }
  std::memcpy(&entry, bytes.data(), sizeof(entry));
  if (entry.size != sizeof(entry)) {
    throw Error(Fault::plugin, fmt::format("the plugin's entry is of {} bytes, this Velum's of {}",
                                           entry.size, sizeof(entry)))
        .at(file.string())
        .hint(kRebuild);
  }
  check_fingerprint(entry.fingerprint, file);
  const std::string_view named(entry.id, ::strnlen(entry.id, sizeof(entry.id)));
  if (named != id) {
    throw Error(
        Fault::plugin,
        fmt::format("the file holds the stage '{}', by its place it should be '{}'", named, id))
        .at(file.string())
        .hint(fmt::format("rename the file to <kind>/<name>.so of '{}', or build it as '{}'", named,
                          id));
  }
}

}  // namespace velum::plugins
