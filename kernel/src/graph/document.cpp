// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "graph/document.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "graph/settings.hpp"
#include "velum/files.hpp"

namespace velum::graph {
namespace {

namespace fs = std::filesystem;
using toml::Kind;

constexpr std::size_t kMaxFiles = 100;

bool is_name(std::string_view name) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  return !name.empty() && std::ranges::all_of(name, good);
}

Parameter parameter(std::string name, ParameterType type, Range range = anything()) {
  Parameter p;
  p.name = std::move(name);
  p.type = type;
  p.range = range;
  return p;
}

fs::path full_path(const fs::path& path) {
  std::error_code fault;
  const fs::path result = fs::absolute(path, fault);
  return fault ? path : result.lexically_normal();
}

fs::path true_path(const fs::path& path) {
  std::error_code fault;
  const fs::path result = fs::weakly_canonical(path, fault);
  return fault ? path.lexically_normal() : result;
}

/// Gives a value and all in it one place.
void place(toml::Node& value, toml::Region where) {
  value.where = where;
  for (toml::Node& item : value.items) place(item, where);
  for (toml::Entry& entry : value.entries) {
    entry.where = where;
    place(entry.value, where);
  }
}

/// Reads the main file and what it includes into one document.
class Reader {
 public:
  Reader(Document& document, Diagnostics& diagnostics)
      : document_(document), diagnostics_(diagnostics) {}

  /// The main file. False when it is no TOML.
  bool read_main(std::string text, const fs::path& name) {
    open_.push_back(true_path(full_path(name)));
    return read(std::move(text), name);
  }

 private:
  bool read(std::string text, const fs::path& name) {
    File& file = document_.files.emplace_back(
        File{Source(name.string(), std::move(text)), full_path(name).parent_path(), {}, {}});
    const Reporter report(diagnostics_, file.source);
    try {
      file.root = toml::parse(file.source.text());
    } catch (const toml::SyntaxError& error) {
      report.error("E0101", error.where(), error.what(), error.hint());
      document_.complete = false;
      return false;
    }
    head(file, report);
    nodes(file, report);
    includes(file, report);
    return true;
  }

  void head(File& file, const Reporter& report) {
    static const std::vector<std::string> known = {"format",  "title", "units",
                                                   "include", "node",  "study"};
    const bool main = document_.files.size() == 1;
    for (const toml::Entry& entry : file.root.entries) {
      if (entry.key == "format") {
        format(entry, report);
      } else if (entry.key == "title") {
        const Setting title = said(entry, ParameterType::text, report);
        if (main && title.is_set()) document_.title = std::get<std::string>(title.value);
      } else if (entry.key == "units") {
        const Setting units = said(entry, ParameterType::length_unit, report);
        if (!units.is_set()) continue;
        file.units.length = length_unit(std::get<std::string>(units.value));
        if (main) document_.units = file.units.length->name;
      } else if (entry.key == "study") {
        if (main) document_.study = &entry;
      } else if (std::ranges::find(known, entry.key) == known.end()) {
        report.error("E0201", entry.where, fmt::format("unknown key '{}'", entry.key),
                     report.helps() ? did_you_mean(entry.key, known) : "", known_list(known));
      }
    }
  }

  static Setting said(const toml::Entry& entry, ParameterType type, const Reporter& report) {
    return parse_setting(parameter(entry.key, type), entry.value, {}, report);
  }

  static void format(const toml::Entry& entry, const Reporter& report) {
    const Setting format = said(entry, ParameterType::integer, report);
    if (format.is_set() && std::get<std::int64_t>(format.value) != 1)
      report.error("E0106", entry.value.where,
                   fmt::format("format {} is not known", entry.value.integer),
                   "this version reads format = 1");
  }

  void nodes(const File& file, const Reporter& report) {
    const toml::Entry* nodes = file.root.find("node");
    if (nodes == nullptr) return;
    if (!nodes->value.is(Kind::table)) {
      report.error("E0204", nodes->where, "'node' must be a table of nodes",
                   "write [node.NAME] above the keys of each");
      return;
    }
    for (const toml::Entry& entry : nodes->value.entries) node(entry, file, report);
  }

  void node(const toml::Entry& entry, const File& file, const Reporter& report) {
    if (!entry.value.is(Kind::table)) {
      report.error("E0204", entry.where, fmt::format("node '{}' must be a table", entry.key),
                   fmt::format("write [node.{}] above its keys", entry.key));
    } else if (!is_name(entry.key)) {
      report.error("E0301", entry.where, fmt::format("'{}' is no name of a node", entry.key),
                   "names are of letters, digits, '_' and '-'");
    } else if (entry.key == "total") {
      report.error("E0301", entry.where, "no node can be called 'total'",
                   "measures of the whole run have that name");
    } else if (names_.size() >= kMaxNodes) {
      if (names_.size() == kMaxNodes && !full_)
        report.error("E0107", entry.where, fmt::format("more than {} nodes", kMaxNodes));
      full_ = true;
    } else if (!names_.insert(entry.key).second) {
      report.error("E0302", entry.where, fmt::format("node '{}' was there already", entry.key),
                   "two files that are merged both have it: give one another name");
    } else {
      Draft draft{entry.key, entry.where, &file, {}};
      for (const toml::Entry& key : entry.value.entries)
        draft.keys.push_back({key.key, key.where, key.value, &file});
      document_.drafts.push_back(std::move(draft));
    }
  }

  void includes(const File& file, const Reporter& report) {
    const toml::Entry* entry = file.root.find("include");
    if (entry == nullptr) return;
    Parameter files = parameter("include", ParameterType::input_file);
    files.list = entry->value.is(Kind::array);
    const Setting setting = parse_setting(files, entry->value, {}, report);
    if (!setting.is_set()) return;
    if (!files.list) {
      include(std::get<std::string>(setting.value), entry->value.where, file, report);
      return;
    }
    const auto& list = std::get<Setting::List>(setting.value);
    for (std::size_t i = 0; i < list.size(); ++i)
      include(std::get<std::string>(list[i].value), entry->value.items[i].where, file, report);
  }

  void include(const std::string& name, toml::Region where, const File& from,
               const Reporter& report) {
    const fs::path shown = (fs::path(from.source.name()).parent_path() / name).lexically_normal();
    const fs::path path = true_path(from.folder / name);
    if (std::ranges::find(open_, path) != open_.end()) {
      report.error("E0103", where, fmt::format("'{}' includes itself", name),
                   "take one of the includes away");
      return;
    }
    if (!seen_.insert(path).second) return;
    if (document_.files.size() >= kMaxFiles) {
      report.error("E0107", where, fmt::format("more than {} files included", kMaxFiles));
      return;
    }
    std::string text;
    try {
      text = FileContent(from.folder / name, toml::kMaxBytes).text();
    } catch (const Error& error) {
      report.error("E0104", where, fmt::format("'{}' {}", name, error.what()),
                   "the name is relative to the file that includes it");
      document_.complete = false;
      return;
    }
    open_.push_back(path);
    read(std::move(text), shown);
    open_.pop_back();
  }

 private:
  Document& document_;
  Diagnostics& diagnostics_;
  std::set<std::string> names_;
  std::set<fs::path> seen_;
  std::vector<fs::path> open_;  ///< files that are being read, each included by the one before
  bool full_ = false;
};

/// Applies one "node.key=VALUE".
void apply(const std::string& text, Document& document, Diagnostics& diagnostics) {
  File& file = document.files.emplace_back(
      File{Source("--set", text), document.files.front().folder, document.files.front().units, {}});
  const Reporter report(diagnostics, file.source);
  const toml::Region whole{{1, 1}, {1, static_cast<std::uint32_t>(text.size()) + 1}};
  const auto equals = text.find('=');
  const auto dot = text.substr(0, equals).find('.');
  if (equals == std::string::npos || dot == std::string::npos) {
    report.error("E0210", whole, fmt::format("'{}' is no setting of a node", text),
                 "write node.parameter=VALUE");
    return;
  }
  const std::string name = text.substr(0, dot);
  const auto draft = std::ranges::find(document.drafts, name, &Draft::name);
  if (draft == document.drafts.end()) {
    std::vector<std::string> known;
    for (const Draft& other : document.drafts) known.push_back(other.name);
    report.error("E0210", {{1, 1}, {1, static_cast<std::uint32_t>(dot) + 1}},
                 fmt::format("there is no node '{}'", name), did_you_mean(name, known),
                 known_list(known));
    return;
  }
  file.folder = draft->file->folder;
  file.units = draft->file->units;
  const auto column = [](std::size_t offset) { return static_cast<std::uint32_t>(offset) + 1; };
  Key key{text.substr(dot + 1, equals - dot - 1),
          {{1, column(dot + 1)}, {1, column(equals)}},
          toml::parse_value(text.substr(equals + 1)),
          &file};
  place(key.value, {{1, column(equals + 1)}, {1, column(text.size())}});
  const auto old = std::ranges::find(draft->keys, key.name, &Key::name);
  if (old == draft->keys.end()) {
    draft->keys.push_back(std::move(key));
  } else {
    *old = std::move(key);
  }
}

}  // namespace

const Key* Draft::find(std::string_view key) const {
  const auto found = std::ranges::find(keys, key, &Key::name);
  return found == keys.end() ? nullptr : &*found;
}

const Draft* Document::find(std::string_view name) const {
  const auto found = std::ranges::lower_bound(drafts, name, {}, &Draft::name);
  return found == drafts.end() || found->name != name ? nullptr : &*found;
}

const std::vector<std::string>& node_keys() {
  static const std::vector<std::string> keys = {"use",   "in",   "isolate", "allow_empty",
                                                "cache", "seed", "limits",  "title"};
  return keys;
}

std::optional<Document> read_document(std::string text, const fs::path& name,
                                      const std::vector<std::string>& overrides,
                                      Diagnostics& diagnostics) {
  std::optional<Document> document(std::in_place);
  Reader reader(*document, diagnostics);
  if (!reader.read_main(std::move(text), name)) return std::nullopt;
  std::ranges::sort(document->drafts, {}, &Draft::name);
  for (const std::string& override : overrides) apply(override, *document, diagnostics);
  return document;
}

}  // namespace velum::graph
