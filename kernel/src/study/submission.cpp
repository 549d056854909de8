// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/submission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "velum/error.hpp"
#include "velum/files.hpp"

namespace velum::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "submission.json";
constexpr const char* kScript = "task.sh";
constexpr std::uint64_t kLargest = std::uint64_t{1} << 30U;

template <class T>
std::optional<T> optional_at(const run::Json& json, const char* name) {
  return json.at(name).is_null() ? std::nullopt : std::optional(json.at(name).get<T>());
}

fs::path mark_of(const fs::path& folder, std::size_t task) {
  return folder / fmt::format("{}.lost", task);
}

/// For a shell (POSIX).
std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::span<const Cell> Submission::cells_of(std::size_t task) const {
  const std::size_t begin = std::min(cells.size(), task * cells_a_task);
  return std::span(cells).subspan(begin, std::min(cells_a_task, cells.size() - begin));
}

void write_submission(const fs::path& folder, const Submission& submission) {
  run::Json cells = run::Json::array();
  for (const Cell& cell : submission.cells) cells.push_back({cell.variant, cell.repeat});
  const run::Json json = {{"velum", kVersion},
                          {"graph", submission.graph.string()},
                          {"text", submission.text},
                          {"overrides", submission.overrides},
                          {"key", submission.key},
                          {"working_folder", submission.working_folder.string()},
                          {"out", submission.out.string()},
                          {"cache", submission.cache.string()},
                          {"threads", submission.threads},
                          {"seconds", run::or_null(submission.seconds)},
                          {"bytes", run::or_null(submission.bytes)},
                          {"cells_a_task", submission.cells_a_task},
                          {"cells", std::move(cells)}};
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed)
    throw Error(Fault::output, "the folder cannot be made: " + failed.message())
        .at(folder.string());
  write_file(folder / kName, run::dump(json) + "\n");
}

std::optional<Submission> read_submission(const fs::path& folder) {
  std::error_code failed;
  if (!fs::is_regular_file(folder / kName, failed)) return std::nullopt;
  try {
    const auto json = run::Json::parse(FileContent(folder / kName, kLargest).text());
    Submission submission{.graph = json.at("graph").get<std::string>(),
                          .text = json.at("text").get<std::string>(),
                          .overrides = json.at("overrides").get<std::vector<std::string>>(),
                          .key = json.at("key").get<std::string>(),
                          .working_folder = json.at("working_folder").get<std::string>(),
                          .out = json.at("out").get<std::string>(),
                          .cache = json.at("cache").get<std::string>(),
                          .threads = json.at("threads").get<int>(),
                          .seconds = optional_at<double>(json, "seconds"),
                          .bytes = optional_at<std::uint64_t>(json, "bytes"),
                          .cells_a_task = json.at("cells_a_task").get<std::size_t>(),
                          .cells = {}};
    for (const run::Json& cell : json.at("cells"))
      submission.cells.push_back({cell.at(0).get<std::size_t>(), cell.at(1).get<std::size_t>()});
    if (submission.cells_a_task == 0) return std::nullopt;
    return submission;
  } catch (const run::Json::exception&) {
    return std::nullopt;
  }
}

fs::path journal_of(const fs::path& folder, std::size_t task) {
  return folder / fmt::format("{}.journal", task);
}

void give_up(const fs::path& folder, std::size_t task) {
  write_file(mark_of(folder, task), "");
}

bool is_given_up(const fs::path& folder, std::size_t task) {
  std::error_code failed;
  // A folder that is gone belongs to a study that was begun anew.
  return fs::exists(mark_of(folder, task), failed) || !fs::exists(folder / kName, failed);
}

fs::path write_task_script(const fs::path& folder) {
  std::string text = "#!/bin/sh\n";
  // A cluster may hand on none of the environment.
  for (const char* name : {"VELUM_PLUGIN_PATH", "XDG_CACHE_HOME"})
    if (const char* value = std::getenv(name))  // NOLINT(concurrency-mt-unsafe)
      text += fmt::format("export {}={}\n", name, shell_quoted(value));
  text +=
      fmt::format("exec {} study-task {}\n", shell_quoted(fs::canonical("/proc/self/exe").string()),
                  shell_quoted(folder.string()));
  const fs::path script = folder / kScript;
  write_file(script, text);
  return script;
}

}  // namespace velum::study
