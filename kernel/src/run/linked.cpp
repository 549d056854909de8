// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/linked.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>
#include <sys/stat.h>

#include <map>
#include <vector>

#include "plugins/search.hpp"
#include "velum/files.hpp"

namespace velum::run {
namespace {

using Libraries = std::map<std::string, std::string, std::less<>>;  // file name → path

Libraries loaded_libraries() {
  Libraries libraries;
  ::dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* to) {
        const std::filesystem::path path = info->dlpi_name;
        if (!path.empty())
          static_cast<Libraries*>(to)->emplace(path.filename().string(), path.string());
        return 0;
      },
      &libraries);
  return libraries;
}

// The names in the DT_NEEDED entries of a library that is open; empty when it is not.
std::vector<std::string> needed(const std::filesystem::path& file) {
  std::vector<std::string> names;
  void* handle = ::dlopen(file.c_str(), RTLD_NOLOAD | RTLD_LAZY);
  link_map* map = nullptr;
  if (handle == nullptr || ::dlinfo(handle, RTLD_DI_LINKMAP, &map) != 0) return names;
  const char* strings = nullptr;
  for (const ElfW(Dyn)* entry = map->l_ld; entry->d_tag != DT_NULL; ++entry)
    if (entry->d_tag == DT_STRTAB)
      strings = reinterpret_cast<const char*>(entry->d_un.d_ptr);  // NOLINT: an address by now
  for (const ElfW(Dyn)* entry = map->l_ld; entry->d_tag != DT_NULL; ++entry)
    if (entry->d_tag == DT_NEEDED && strings != nullptr)
      names.emplace_back(strings + entry->d_un.d_val);
  ::dlclose(handle);
  return names;
}

}  // namespace

std::string linked_libraries(const std::filesystem::path& plugin) {
  const Libraries loaded = loaded_libraries();
  std::string text;
  for (const std::string& name : needed(plugin)) {
    const auto found = loaded.find(name);
    struct stat status = {};
    if (found == loaded.end() || ::stat(found->second.c_str(), &status) != 0) continue;
    text += fmt::format("{} {} {}\n", name, status.st_size, status.st_mtim.tv_sec);
  }
  return text;
}

const std::string& kernel_hash() {
  static const std::string hash =
      hash_of(FileContent(plugins::library_folder() / "libvelum.so").bytes());
  return hash;
}

}  // namespace velum::run
