// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/slurm_queue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <sstream>
#include <utility>

#include "study/program.hpp"
#include "velum/error.hpp"
#include "velum/files.hpp"

namespace velum::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNoSlurm = "--engine local runs the study on this machine";

/// Slurm's limit in whole minutes, rounded up.
std::string minutes(double seconds) {
  return fmt::format("{:.0f}", std::ceil(seconds / 60.0));
}

/// In MiB, rounded up.
std::string mebibytes(std::uint64_t bytes) {
  return fmt::format("{}M", (bytes + (1U << 20U) - 1) >> 20U);
}

/// The last line that is not empty.
std::string last_line(std::string text) {
  text.erase(text.find_last_not_of("\n ") + 1);
  return text.substr(text.find_last_of('\n') + 1);
}

/// "job|index|state|nodes|reason|folder"
std::optional<QueuedTask> parse_task(const std::string& line) {
  std::array<std::string, 6> fields;
  std::size_t from = 0;
  for (std::size_t f = 0; f + 1 < fields.size(); ++f) {
    const auto to = line.find('|', from);
    if (to == std::string::npos) return std::nullopt;
    fields.at(f) = line.substr(from, to - from);
    from = to + 1;
  }
  fields.back() = line.substr(from);
  QueuedTask task{fields[0], 0, fields[2], fields[3], fields[4], fields[5]};
  const auto parsed =
      std::from_chars(fields[1].data(), fields[1].data() + fields[1].size(), task.index);
  if (parsed.ec != std::errc()) return std::nullopt;
  return task;
}

}  // namespace

bool QueuedTask::ended() const {
  constexpr std::array<std::string_view, 11> kEnded = {
      "BOOT_FAIL", "CANCELLED", "COMPLETED",     "DEADLINE", "FAILED", "LAUNCH_FAILED",
      "NODE_FAIL", "PREEMPTED", "OUT_OF_MEMORY", "REVOKED",  "TIMEOUT"};
  return std::ranges::find(kEnded, state) != kEnded.end();
}

std::string SlurmQueue::submit(const TaskArray& array, const graph::Slurm& wishes) const {
  std::vector<std::string> words = {
      "sbatch", "--parsable", "--job-name=" + name_, "--chdir=" + array.folder.string(),
      "--output=%a.log",
      // A task that was lost is submitted anew by the study, which knows what of it is done.
      "--no-requeue", fmt::format("--cpus-per-task={}", wishes.cpus)};
  std::string range = fmt::format("--array=0-{}", array.tasks - 1);
  if (array.at_once > 0) range += fmt::format("%{}", array.at_once);
  words.push_back(range);
  if (array.exclusive) words.emplace_back("--exclusive");
  if (!wishes.account.empty()) words.push_back("--account=" + wishes.account);
  if (!wishes.partition.empty()) words.push_back("--partition=" + wishes.partition);
  if (wishes.seconds) words.push_back("--time=" + minutes(*wishes.seconds));
  if (wishes.bytes) words.push_back("--mem=" + mebibytes(*wishes.bytes));
  words.insert(words.end(), wishes.options.begin(), wishes.options.end());
  words.push_back(array.script.string());
  Said said;
  try {
    said = run_program(words);
  } catch (Error& error) {
    throw std::move(error).hint(kNoSlurm);
  }
  if (said.status != 0)
    throw Error(Fault::graph, "Slurm refuses the study's tasks: " + last_line(said.error))
        .hint("see [study.slurm] and --slurm, and what `sinfo` says");
  // "12" or "12;cluster"
  const std::string answer = last_line(said.out);
  return answer.substr(0, answer.find(';'));
}

std::optional<std::vector<QueuedTask>> SlurmQueue::tasks() const {
  Said said;
  try {
    said = run_program({"squeue", "--noheader", "--array", "--me", "--states=all",
                        "--name=" + name_, "--format=%F|%K|%T|%N|%r|%Z"});
  } catch (Error& error) {
    throw std::move(error).hint(kNoSlurm);
  }
  if (said.status != 0) return std::nullopt;
  std::vector<QueuedTask> tasks;
  std::istringstream lines(said.out);
  for (std::string line; std::getline(lines, line);)
    if (auto task = parse_task(line)) tasks.push_back(std::move(*task));
  return tasks;
}

std::string slurm_name(const fs::path& study) {
  const std::string name = fs::weakly_canonical(fs::absolute(study)).string();
  return "velum-" + hash_of(std::as_bytes(std::span(name))).substr(0, 10);
}

}  // namespace velum::study
