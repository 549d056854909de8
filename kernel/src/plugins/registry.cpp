// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "plugins/registry.hpp"

#include <fmt/format.h>

#include "graph/diagnostic.hpp"
#include "plugins/entry.hpp"
#include "plugins/library.hpp"
#include "plugins/probe.hpp"
#include "velum/files.hpp"

namespace velum::plugins {

Registry::Registry(Trust trust, std::vector<std::filesystem::path> path)
    : trust_(trust), path_(std::move(path)) {}

const StageInfo* Registry::find(std::string_view id) {
  const Slot& found = slot(id);
  return found.stage == nullptr ? nullptr : &found.stage->info();
}

std::string Registry::why_not(std::string_view id) {
  const Slot& found = slot(id);
  if (!found.failed || found.failed->fault() != Fault::plugin) return "";
  return one_line(*found.failed);
}

std::vector<std::string> Registry::ids() {
  std::vector<std::string> ids;
  for (const auto& [id, files] : find_plugins(path_)) ids.push_back(id);
  return ids;
}

const StageType& Registry::stage(std::string_view id) {
  const Slot& found = slot(id);
  if (found.failed) throw Error(*found.failed);
  return *found.stage;
}

std::filesystem::path Registry::file(std::string_view id) {
  Files files = find_plugin(path_, id);
  if (files.empty()) throw unknown(id);
  return std::move(files.front());
}

std::string Registry::file_hash(std::string_view id) {
  return hash_of(FileContent(file(id)).bytes());
}

const Registry::Slot& Registry::slot(std::string_view id) {
  const std::lock_guard lock(mutex_);
  const auto known = slots_.find(id);
  if (known != slots_.end()) return known->second;
  return slots_.emplace(std::string(id), open(id)).first->second;
}

Registry::Slot Registry::open(std::string_view id) const {
  Slot slot;
  const Files files = find_plugin(path_, id);
  if (files.empty()) {
    slot.failed = unknown(id);
    return slot;
  }
  try {
    check_entry(files.front(), id);
    if (trust_ == Trust::probe) require_sound(files.front());
    slot.stage = &open_stage(files.front());
  } catch (const Error& error) {
    slot.failed = error;
  }
  return slot;
}

Error Registry::unknown(std::string_view id) const {
  std::vector<std::string> known;
  for (const auto& [name, files] : find_plugins(path_)) known.push_back(name);
  std::string hint = graph::did_you_mean(id, known);
  if (hint.empty()) {
    hint = "`velum list` shows all stages; plugins are looked for in";
    for (const auto& folder : path_) hint += " " + folder.string();
  }
  return Error(Fault::graph, fmt::format("there is no stage '{}'", id)).hint(std::move(hint));
}

std::string one_line(const Error& error) {
  std::string line = error.where().empty() ? "" : error.where() + ": ";
  line += error.what();
  if (!error.hint().empty()) line += " (" + error.hint() + ")";
  return line;
}

}  // namespace velum::plugins
