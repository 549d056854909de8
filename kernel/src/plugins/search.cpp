// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "plugins/search.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "velum/error.hpp"

namespace velum::plugins {
namespace {

namespace fs = std::filesystem;

void add_folder(std::vector<fs::path>& path, const fs::path& folder) {
  std::error_code failed;
  // The same folder by another name would make every plugin hide itself.
  const fs::path whole = fs::weakly_canonical(folder, failed);
  if (failed || std::find(path.begin(), path.end(), whole) != path.end()) return;
  path.push_back(whole);
}

void add_kind(const fs::path& folder, std::map<std::string, Files, std::less<>>& plugins) {
  const std::string kind = folder.filename().string();
  if (!is_name(kind)) return;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed)) {
    const fs::path& file = entry.path();
    if (file.extension() == ".so" && is_name(file.stem().string()))
      plugins[kind + "." + file.stem().string()].push_back(file);
  }
}

}  // namespace

bool is_name(std::string_view text) {
  const auto lower = [](char c) { return c >= 'a' && c <= 'z'; };
  return !text.empty() && lower(text.front()) && std::all_of(text.begin(), text.end(), [&](char c) {
    return lower(c) || (c >= '0' && c <= '9') || c == '_';
  });
}

bool is_id(std::string_view text) {
  const auto dot = text.find('.');
  return dot != std::string_view::npos && is_name(text.substr(0, dot)) &&
         is_name(text.substr(dot + 1));
}

fs::path library_folder() {
  Dl_info found = {};
  if (::dladdr(reinterpret_cast<const void*>(&library_folder), &found) == 0)  // NOLINT
    throw Error(Fault::plugin, "the place of libvelum.so cannot be found");
  return fs::weakly_canonical(found.dli_fname).parent_path();
}

std::vector<fs::path> search_path() {
  std::vector<fs::path> path;
  const char* variable = std::getenv("VELUM_PLUGIN_PATH");  // NOLINT(concurrency-mt-unsafe)
  const std::string_view listed = variable == nullptr ? "" : variable;
  for (std::size_t begin = 0; begin < listed.size();) {
    const std::size_t end = std::min(listed.find(':', begin), listed.size());
    if (end > begin) add_folder(path, listed.substr(begin, end - begin));
    begin = end + 1;
  }
  const fs::path own = library_folder();
  std::error_code ignored;
  const fs::path tree = own.parent_path();
  if (fs::exists(tree / "CMakeCache.txt", ignored)) add_folder(path, tree / "plugins");
  add_folder(path, own / "velum" / "plugins");
  return path;
}

std::map<std::string, Files, std::less<>> find_plugins(const std::vector<fs::path>& path) {
  std::map<std::string, Files, std::less<>> plugins;
  for (const fs::path& folder : path) {
    std::error_code failed;
    for (const auto& kind : fs::directory_iterator(folder, failed))
      if (kind.is_directory(failed)) add_kind(kind.path(), plugins);
  }
  return plugins;
}

Files find_plugin(const std::vector<fs::path>& path, std::string_view id) {
  Files files;
  if (!is_id(id)) return files;
  const auto dot = id.find('.');
  for (const fs::path& folder : path) {
    fs::path file = folder / id.substr(0, dot) / id.substr(dot + 1);
    file += ".so";
    std::error_code failed;
    // A link that leads nowhere is a plugin that cannot be loaded, not one that nobody knows.
    if (fs::exists(fs::symlink_status(file, failed))) files.push_back(std::move(file));
  }
  return files;
}

}  // namespace velum::plugins
