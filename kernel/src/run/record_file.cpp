// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/record_file.hpp"

#include <fmt/format.h>

#include "velum/files.hpp"

namespace velum::run {
namespace {

Error not_a_record(const std::filesystem::path& file, const std::string& found) {
  return Error(Fault::input, "not a run record: " + found)
      .at(file.string())
      .hint("a run record is the run.json that `velum run` leaves in its output folder");
}

Json parse(const std::filesystem::path& file) {
  const FileContent content(file);
  try {
    return Json::parse(content.text());
  } catch (const Json::parse_error& error) {
    throw not_a_record(file, fmt::format("it is no JSON from byte {} on", error.byte));
  } catch (const Json::exception&) {
    throw not_a_record(file, "a number in it is out of range");
  }
}

bool has(const Json& record, std::string_view key) {
  const Json* at = &record;
  while (!key.empty()) {
    const std::size_t point = std::min(key.find('.'), key.size());
    const auto found = at->find(std::string(key.substr(0, point)));
    if (found == at->end()) return false;
    at = &*found;
    key.remove_prefix(std::min(point + 1, key.size()));
  }
  return true;
}

}  // namespace

Json read_record(const std::filesystem::path& file, const std::vector<std::string>& keys) {
  Json record = parse(file);
  if (!record.is_object())
    throw not_a_record(
        file, fmt::format("found JSON of kind {}, expected an object", record.type_name()));
  for (const std::string& key : keys)
    if (!has(record, key)) throw not_a_record(file, fmt::format("it has no '{}'", key));
  return record;
}

Error damaged_record(const std::filesystem::path& file) {
  return not_a_record(file, "a value in it is missing or of another kind than a run writes");
}

}  // namespace velum::run
