// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "graph/check.hpp"

namespace velum::graph {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxListed = 1000;  // files of a folder that a missing one is compared with

/// What is wrong with one name; nothing when the message is empty.
struct Trouble {
  std::string message;
  std::string hint;
  Fault fault = Fault::graph;
};

std::string neighbours_hint(const fs::path& path) {
  std::vector<std::string> names;
  std::error_code fault;
  fs::directory_iterator entry(path.parent_path(), fault);
  for (int n = 0; !fault && entry != fs::directory_iterator() && n < kMaxListed; ++n) {
    names.push_back(entry->path().filename().string());
    entry.increment(fault);
  }
  return did_you_mean(path.filename().string(), names);
}

Trouble input_trouble(const fs::path& path, const std::string& name) {
  std::error_code fault;
  const fs::file_status status = fs::status(path, fault);
  if (status.type() == fs::file_type::not_found || status.type() == fs::file_type::none) {
    std::string hint = neighbours_hint(path);
    return {fmt::format("there is no file '{}'", name),
            hint.empty() ? "the name is relative to the graph's folder" : hint};
  }
  if (status.type() == fs::file_type::directory)
    return {fmt::format("'{}' is a folder, not a file", name), ""};
  if (!fs::is_regular_file(status)) return {fmt::format("'{}' is no regular file", name), ""};
  if (::access(path.c_str(), R_OK) != 0)
    return {fmt::format("'{}' cannot be read: no permission", name), ""};
  return {};
}

/// The nearest folder above `path` that is there must take new files.
Trouble folder_trouble(const fs::path& path, const std::string& name) {
  std::error_code fault;
  for (fs::path folder = path.parent_path();; folder = folder.parent_path()) {
    const fs::file_status status = fs::status(folder, fault);
    if (status.type() == fs::file_type::not_found && folder != folder.parent_path()) continue;
    if (!fs::is_directory(status))
      return {fmt::format("'{}' cannot be written: '{}' is no folder", name, folder.string()), "",
              Fault::output};
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
      return {fmt::format("'{}' cannot be written: no permission in '{}'", name, folder.string()),
              "choose another folder with --out", Fault::output};
    return {};
  }
}

/// Files, and folders, that a run keeps for itself in the output folder.
bool is_reserved(const fs::path& path) {
  const fs::path first = *path.begin();
  return first == "run.json" || first == "report.html" || first == "views.bin" ||
         first == "study.json" || first == "study.csv" || first.string().starts_with(".velum.");
}

Trouble output_trouble(const fs::path& path, const std::string& name,
                       const std::optional<fs::path>& out) {
  if (path.is_absolute())
    return {fmt::format("'{}' is an absolute path", name),
            "outputs are written below --out: give a relative name"};
  if (*path.begin() == "..")
    return {fmt::format("'{}' leaves the output folder", name), "outputs are written below --out"};
  if (!path.has_filename() || path == ".") return {fmt::format("'{}' names no file", name), ""};
  if (is_reserved(path))
    return {fmt::format("'{}' is a name of the run's own", name), "choose another name"};
  if (!out) return {};
  std::error_code fault;
  const fs::path target = fs::absolute(*out / path, fault);
  const fs::file_status status = fs::status(target, fault);
  if (fs::exists(status) && !fs::is_regular_file(status))
    return {
        fmt::format("'{}' cannot be written: it is there and is no regular file", target.string()),
        "", Fault::output};
  return folder_trouble(target, name);
}

/// Checks the files of all nodes; two that write one file included.
class Files {
 public:
  explicit Files(Check& check) : check_(check) {}

  void node(Checked& checked) {
    if (checked.node.info == nullptr) return;
    const auto& parameters = checked.node.info->parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const Key* key = checked.given[i];
      if (key == nullptr || !checked.node.settings[i].is_set()) continue;
      node_ = &checked.node;
      key_ = key;
      value(parameters[i], key->value, checked.node.settings[i]);
    }
  }

 private:
  /// `written` is what `setting` was read from.
  void value(const Parameter& parameter, const toml::Node& written, Setting& setting) {
    if (auto* list = std::get_if<Setting::List>(&setting.value)) {
      const bool rows = parameter.type == ParameterType::rows;
      for (std::size_t i = 0; i < list->size() && i < written.items.size(); ++i)
        rows ? row(parameter, written.items[i], (*list)[i])
             : value(parameter, written.items[i], (*list)[i]);
    } else if (parameter.type == ParameterType::input_file) {
      input(written, std::get<std::string>(setting.value));
    } else if (parameter.type == ParameterType::output_file) {
      output(written, std::get<std::string>(setting.value));
    }
  }

  void row(const Parameter& parameter, const toml::Node& written, Setting& setting) {
    auto& cells = std::get<Setting::List>(setting.value);
    for (std::size_t i = 0; i < parameter.fields.size() && i < cells.size(); ++i) {
      const toml::Entry* entry = written.find(parameter.fields[i].name);
      if (entry != nullptr) value(parameter.fields[i], entry->value, cells[i]);
    }
  }

  void input(const toml::Node& written, std::string& name) {
    const fs::path path = (key_->file->folder / name).lexically_normal();
    report("E0501", written, input_trouble(path, name));
    name = path.string();
  }

  void output(const toml::Node& written, std::string& name) {
    const fs::path path = fs::path(name).lexically_normal();
    const Trouble trouble = output_trouble(path, name, check_.options.out);
    report("E0502", written, trouble);
    if (!trouble.message.empty()) return;
    const auto [first, added] = writers_.emplace(path.string(), node_->name);
    if (!added)
      report("E0503", written,
             {fmt::format("'{}' is written by node '{}' too", name, first->second),
              "give one of them another name"});
    else
      file_and_folder(written, path);
    name = path.string();
  }

  /// Refuses a name that is a file of one node and a folder of another.
  void file_and_folder(const toml::Node& written, const fs::path& path) {
    const auto refuse = [&](const std::string& name, const std::string& node) {
      report("E0503", written,
             {fmt::format("'{}' is a file of one node and a folder of another, see node '{}'", name,
                          node),
              "give one of them another name"});
    };
    if (const auto folder = folders_.find(path.string()); folder != folders_.end())
      return refuse(path.string(), folder->second);
    for (fs::path part = path.parent_path(); !part.empty(); part = part.parent_path()) {
      if (const auto file = writers_.find(part.string()); file != writers_.end())
        return refuse(part.string(), file->second);
      folders_.emplace(part.string(), node_->name);
    }
  }

  void report(const char* code, const toml::Node& written, const Trouble& trouble) const {
    if (trouble.message.empty()) return;
    check_.report(*key_)
        .error(code, written.where, fmt::format("{}: {}", call(*node_), trouble.message),
               trouble.hint)
        .fault = trouble.fault;
  }

  Check& check_;
  const Node* node_ = nullptr;
  const Key* key_ = nullptr;
  std::map<std::string, std::string> writers_;  ///< node by file
  std::map<std::string, std::string> folders_;  ///< node by folder of a file
};

}  // namespace

void check_files(Check& check) {
  Files files(check);
  for (Checked& checked : check.nodes) files.node(checked);
}

}  // namespace velum::graph
