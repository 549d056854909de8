// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "plugins/scaffold.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "graph/diagnostic.hpp"
#include "plugins/search.hpp"
#include "velum/error.hpp"
#include "velum/files.hpp"

namespace velum::plugins {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kKinds = {"analysis",     "devices",    "features",
                                         "filtering",    "io",         "meshing",
                                         "registration", "resampling", "segmentation"};
constexpr std::size_t kLongestName = 40;

struct Names {
  std::string kind;
  std::string name;
  std::string type;  ///< PascalCase
};

std::string pascal_case(const std::string& name) {
  std::string type;
  bool upper = true;
  for (const char c : name) {
    if (c != '_')
      type += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = c == '_';
  }
  return type;
}

Names names_of(const std::string& id) {
  const auto dot = id.find('.');
  const std::string kind = id.substr(0, dot);
  const std::string name = dot == std::string::npos ? "" : id.substr(dot + 1);
  if (!is_id(id) || name.size() > kLongestName) {
    throw Error(Fault::graph, fmt::format("'{}' is no name for a stage", id))
        .hint(
            fmt::format("it is KIND.NAME, the name of lower-case letters, digits and underscores, "
                        "at most {}, a letter first: resampling.my_method",
                        kLongestName));
  }
  if (std::find(kKinds.begin(), kKinds.end(), kind) == kKinds.end()) {
    const std::string guess = graph::did_you_mean(kind, kKinds);
    const std::string known = graph::known_list(kKinds);
    throw Error(Fault::graph, fmt::format("'{}' is no kind of stage", kind))
        .hint(guess.empty() ? known : guess + "  (" + known + ")");
  }
  return {kind, name, pascal_case(name)};
}

std::string filled_in(std::string text, const Names& names) {
  const std::pair<std::string, std::string> marks[] = {{"{{kind}}", names.kind},
                                                       {"{{name}}", names.name},
                                                       {"{{id}}", names.kind + "." + names.name},
                                                       {"{{Type}}", names.type}};
  for (const auto& [mark, value] : marks)
    for (auto at = text.find(mark); at != std::string::npos;
         at = text.find(mark, at + value.size()))
      text.replace(at, mark.size(), value);
  return text;
}

/// The root of the checkout whose sources `where` lies among; what is below build/ is none of them.
std::optional<fs::path> checkout_of(const fs::path& where) {
  std::error_code failed;
  const fs::path place = fs::weakly_canonical(where);
  for (fs::path folder = place;; folder = folder.parent_path()) {
    if (fs::exists(folder / "kernel/include/velum/stage.hpp", failed) &&
        fs::exists(folder / "plugins/CMakeLists.txt", failed)) {
      const bool built = *place.lexically_relative(folder).begin() == "build";
      return built ? std::nullopt : std::optional(folder);
    }
    if (folder == folder.parent_path()) return std::nullopt;
  }
}

void append_line(const fs::path& file, const std::string& line) {
  std::string text;
  std::error_code failed;
  if (fs::exists(file, failed)) text = FileContent(file).text();
  if (!text.empty() && text.back() != '\n') text += '\n';
  write_file(file, text + line + "\n");
}

fs::path make_folder(const fs::path& folder) {
  std::error_code failed;
  if (fs::exists(fs::symlink_status(folder, failed))) {
    throw Error(Fault::graph, "there is such a folder already")
        .at(folder.string())
        .hint("choose another name, or remove the folder");
  }
  fs::create_directories(folder, failed);
  if (failed) throw Error(Fault::output, failed.message()).at(folder.string());
  return folder;
}

}  // namespace

Scaffold new_plugin(const std::string& id, const fs::path& where) {
  const Names names = names_of(id);
  const auto checkout = checkout_of(where);
  Scaffold made;
  made.in_checkout = checkout.has_value();
  made.folder = make_folder(made.in_checkout ? *checkout / "plugins" / names.kind / names.name
                                             : fs::weakly_canonical(where) / names.name);
  for (const auto& [name, text] : templates()) {
    if (made.in_checkout && name == "CMakeLists.txt") continue;
    std::string file = name;
    if (file.rfind("stage", 0) == 0) file.replace(0, 5, names.name);
    made.files.push_back(made.folder / file);
    write_file(made.files.back(), filled_in(text, names));
  }
  if (made.in_checkout) {
    made.files.push_back(made.folder.parent_path() / "CMakeLists.txt");
    append_line(made.files.back(), fmt::format("velum_plugin({} {})", names.kind, names.name));
  }
  return made;
}

}  // namespace velum::plugins
