// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/slurm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "study/folder.hpp"
#include "study/journal.hpp"
#include "velum/error.hpp"
#include "velum/files.hpp"

namespace velum::study {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using CellName = std::pair<std::size_t, std::size_t>;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds kNap{100};
/// Journals of tasks are looked at so often.
constexpr milliseconds kGather{1000};
/// Slurm is asked so often at first, and ever less often the longer the study lasts.
constexpr milliseconds kFirstLook{2000};
constexpr milliseconds kLastLook{20'000};
/// So long after its end what a task has written is waited for: a network file system may show it
/// late. The longer time is that of tasks of which Slurm says that they have done all.
constexpr seconds kPatience{5};
constexpr seconds kLongPatience{60};

constexpr const char* kNoAnswer = "Slurm does not answer: squeue has failed";

struct Task {
  std::size_t index = 0;
  std::string job;
  std::string state = "PENDING";
  std::string nodes;
  std::string reason;
  bool listed = false;                    ///< when Slurm was asked last
  std::optional<Clock::time_point> gone;  ///< since when it does no more
  std::size_t read = 0;                   ///< of its journal [bytes]
};

std::vector<Task> tasks_of(std::size_t count, const std::string& job) {
  std::vector<Task> tasks(count);
  for (std::size_t t = 0; t < count; ++t) {
    tasks[t].index = t;
    tasks[t].job = job;
  }
  return tasks;
}

/// A job array, and its tasks of which an outcome is still missing.
struct Job {
  fs::path folder;
  Submission submission;
  std::vector<Task> open;
};

fs::path tasks_folder(const fs::path& study) {
  return study / kTasksName;
}

/// The submissions of this key that a study's folder has, the oldest first.
std::vector<Job> earlier_jobs(const fs::path& study, const std::string& key) {
  std::vector<fs::path> folders;
  std::error_code none;
  for (auto entry = fs::directory_iterator(tasks_folder(study), none); entry != fs::end(entry);
       entry.increment(none))
    folders.push_back(entry->path());
  std::ranges::sort(folders);
  std::vector<Job> jobs;
  for (const fs::path& folder : folders) {
    auto submission = read_submission(folder);
    if (!submission || submission->key != key) continue;
    std::vector<Task> tasks = tasks_of(submission->tasks(), "");
    jobs.push_back({folder, std::move(*submission), std::move(tasks)});
  }
  return jobs;
}

/// What the task printed last: mostly why it ended.
std::string last_words(const fs::path& folder, const Task& task) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 24U;
  try {
    std::string text(FileContent(folder / fmt::format("{}.log", task.index), kMost).text());
    text.erase(text.find_last_not_of("\n ") + 1);
    return text.substr(text.find_last_of('\n') + 1);
  } catch (const Error&) {
    return "";
  }
}

std::string how_it_ended(const fs::path& folder, const Task& task) {
  std::string text = fmt::format("task {}_{} ended as {}", task.job, task.index, task.state);
  if (!task.nodes.empty()) text += " on " + task.nodes;
  const std::string words = last_words(folder, task);
  return words.empty() ? text : text + ": " + words;
}

Status status_of(const std::string& state) {
  if (state == "TIMEOUT" || state == "DEADLINE") return Status::timed_out;
  return state == "OUT_OF_MEMORY" ? Status::out_of_memory : Status::crashed;
}

class Follower {
 public:
  Follower(const std::vector<Cell>& cells, const SlurmOptions& options,
           const std::function<void(const Cell&, Outcome)>& done)
      : options_(options), done_(done), queue_(slurm_name(options.common.out)) {
    for (const Cell& cell : cells) missing_.insert({cell.variant, cell.repeat});
    take_up();
    for (const Cell& cell : cells)
      if (missing_.contains({cell.variant, cell.repeat}) &&
          !under_way_.contains({cell.variant, cell.repeat}))
        left_.push_back(cell);
  }

  bool run() {
    while (!missing_.empty() && !cancelled()) {
      submit();
      if (jobs_.empty() && left_.empty()) return false;  // what is missing was cancelled
      nap();
      gather();
      if (Clock::now() >= next_look_) look();
    }
    return missing_.empty();
  }

 private:
  [[nodiscard]] bool cancelled() const { return options_.cancel != nullptr && *options_.cancel; }

  /// What earlier tasks have done is gathered; those that wait or run are followed, others given
  /// up.
  void take_up() {
    jobs_ = earlier_jobs(options_.common.out, options_.common.key);
    const auto listed = queue_.tasks();
    if (!listed) throw Error(Fault::graph, kNoAnswer);
    mark(*listed);
    std::size_t alive = 0;
    for (Job& job : jobs_) {
      for (Task& task : job.open)
        if (!is_given_up(job.folder, task.index)) read(job, task);
      std::erase_if(job.open, [&](const Task& task) {
        if (!is_open(job, task) || is_given_up(job.folder, task.index)) return true;
        if (task.listed && !task.gone) return false;
        give_up(job.folder, task.index);
        return true;
      });
      alive += job.open.size();
      for (const Task& task : job.open)
        for (const Cell& cell : job.submission.cells_of(task.index))
          under_way_.insert({cell.variant, cell.repeat});
    }
    std::erase_if(jobs_, [](const Job& job) { return job.open.empty(); });
    if (alive > 0) options_.note(fmt::format("{} tasks that wait or run are taken up", alive));
  }

  /// In arrays of as many tasks as a job may have.
  void submit() {
    if (left_.empty() || Clock::now() < next_submission_) return;
    const std::size_t a_task =
        options_.wishes.cells ? static_cast<std::size_t>(*options_.wishes.cells)
                              : (left_.size() + options_.wishes.array - 1) / options_.wishes.array;
    while (!left_.empty() && !cancelled()) {
      Submission submission = options_.common;
      submission.cells_a_task = a_task;
      const auto count =
          static_cast<std::ptrdiff_t>(std::min(left_.size(), a_task * options_.wishes.array));
      submission.cells.assign(left_.begin(), left_.begin() + count);
      if (!submit(std::move(submission))) return;
      left_.erase(left_.begin(), left_.begin() + count);
    }
  }

  /// False when Slurm takes no more for now.
  bool submit(Submission submission) {
    const fs::path folder = new_folder();
    write_submission(folder, submission);
    const TaskArray array{folder, write_task_script(folder), submission.tasks(), options_.at_once,
                          options_.exclusive};
    std::string number;
    try {
      number = queue_.submit(array, options_.wishes);
    } catch (const Error&) {
      std::error_code ignored;
      fs::remove_all(folder, ignored);
      if (jobs_.empty()) throw;
      // Clusters limit what one user may have in the queue: it is tried again.
      next_submission_ = Clock::now() + kLastLook;
      return false;
    }
    options_.note(
        fmt::format("job {}: {} cells in {} tasks", number, submission.cells.size(), array.tasks));
    jobs_.push_back({folder, std::move(submission), tasks_of(array.tasks, number)});
    next_look_ = Clock::now() + kFirstLook;
    return true;
  }

  /// Never a name that was there before: a task that comes late must not find another's cells.
  [[nodiscard]] fs::path new_folder() const {
    std::random_device random;
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return tasks_folder(options_.common.out) /
           fmt::format("{:010}-{:08x}", std::chrono::duration_cast<seconds>(now).count(), random());
  }

  void nap() {
    const auto until = std::min(next_look_, Clock::now() + kGather);
    while (Clock::now() < until && !cancelled()) std::this_thread::sleep_for(kNap);
  }

  [[nodiscard]] bool is_open(const Job& job, const Task& task) const {
    return std::ranges::any_of(job.submission.cells_of(task.index), [&](const Cell& cell) {
      return missing_.contains({cell.variant, cell.repeat});
    });
  }

  /// Takes what a task has written since.
  void read(const Job& job, Task& task) {
    task.read = Journal::read(journal_of(job.folder, task.index), task.read,
                              [&](const Cell& cell, Outcome outcome) {
                                if (missing_.erase({cell.variant, cell.repeat}) == 0) return;
                                began_ = true;
                                done_(cell, std::move(outcome));
                              });
  }

  void gather() {
    for (Job& job : jobs_) {
      for (Task& task : job.open)
        if (task.state != "PENDING") read(job, task);
      std::erase_if(job.open, [&](const Task& task) { return !is_open(job, task); });
    }
    std::erase_if(jobs_, [](const Job& job) { return job.open.empty(); });
  }

  void mark(const std::vector<QueuedTask>& listed) {
    std::map<std::pair<std::string, std::size_t>, const QueuedTask*> found;
    for (const QueuedTask& task : listed)
      found[{task.folder.filename().string(), task.index}] = &task;
    for (Job& job : jobs_)
      for (Task& task : job.open) {
        const auto known = found.find({job.folder.filename().string(), task.index});
        task.listed = known != found.end();
        if (task.listed) {
          const QueuedTask& queued = *known->second;
          task.job = queued.job;
          task.state = queued.state;
          task.nodes = queued.nodes;
          task.reason = queued.reason;
        } else if (task.state == "PENDING") {
          // Of tasks that are cancelled before they run Slurm keeps one line for all.
          task.state = "CANCELLED";
        }
        if (task.listed && !known->second->ended())
          task.gone.reset();
        else if (!task.gone)
          task.gone = Clock::now();
      }
  }

  void look() {
    const auto passed = Clock::now() - began_looking_;
    next_look_ = Clock::now() + std::clamp(std::chrono::duration_cast<milliseconds>(passed / 20),
                                           kFirstLook, kLastLook);
    const auto listed = queue_.tasks();
    if (!listed) {
      tell("Slurm does not answer; it is asked again");
      return;
    }
    mark(*listed);
    tell_counts();
    gather_ended();
  }

  void gather_ended() {
    const std::size_t cancelled = cancelled_;
    for (Job& job : jobs_) {
      for (Task& task : job.open)
        if (task.gone) read(job, task);
      std::erase_if(job.open, [&](const Task& task) {
        if (!is_open(job, task)) return true;
        if (!is_lost(task)) return false;
        lose(job, task);
        return true;
      });
    }
    std::erase_if(jobs_, [](const Job& job) { return job.open.empty(); });
    if (cancelled_ > cancelled)
      options_.note(
          fmt::format("{} tasks were cancelled; --resume submits their cells again", cancelled_));
  }

  [[nodiscard]] static bool is_lost(const Task& task) {
    if (!task.gone) return false;
    const bool well = task.state == "COMPLETED" || (!task.listed && task.state != "CANCELLED");
    return Clock::now() - *task.gone > (well ? kLongPatience : kPatience);
  }

  /// The cell that it was at has had one of its tries; those behind it have not.
  void lose(const Job& job, const Task& task) {
    give_up(job.folder, task.index);
    if (task.state == "CANCELLED") {
      ++cancelled_;
      return;
    }
    const std::string how = how_it_ended(job.folder, task);
    options_.note(how);
    if (task.state == "FAILED" && !began_)
      throw Error(Fault::graph, "Slurm's tasks cannot run the study: " + how)
          .at((job.folder / fmt::format("{}.log", task.index)).string());
    bool at_it = true;
    for (const Cell& cell : job.submission.cells_of(task.index)) {
      const CellName name{cell.variant, cell.repeat};
      if (!missing_.contains(name)) continue;
      if (at_it && ++tries_[name] >= kMostTries) {
        missing_.erase(name);
        Outcome outcome;
        outcome.status = status_of(task.state);
        outcome.message = fmt::format("lost {} times; the last one: {}", kMostTries, how);
        done_(cell, std::move(outcome));
      } else {
        left_.push_back(cell);
      }
      at_it = false;
    }
  }

  void tell_counts() {
    std::size_t waiting = 0;
    std::size_t running = 0;
    std::set<std::string> reasons;
    for (const Job& job : jobs_)
      for (const Task& task : job.open) {
        if (task.gone) continue;
        (task.state == "PENDING" ? waiting : running) += 1;
        if (task.state == "PENDING") reasons.insert(task.reason);
      }
    std::string text = fmt::format("{} tasks run, {} wait", running, waiting);
    // What is usual needs no word.
    for (const char* usual : {"None", "Priority", "Resources", "JobArrayTaskLimit"})
      reasons.erase(usual);
    if (!reasons.empty()) text += " (" + *reasons.begin() + ")";
    tell(text);
  }

  /// What is said again and again is said once.
  void tell(const std::string& text) {
    if (text == told_) return;
    told_ = text;
    options_.note(text);
  }

  const SlurmOptions& options_;
  const std::function<void(const Cell&, Outcome)>& done_;
  SlurmQueue queue_;
  std::set<CellName> missing_;    ///< cells of which there is no outcome yet
  std::set<CellName> under_way_;  ///< those of tasks that were taken up
  std::deque<Cell> left_;         ///< to be submitted
  std::map<CellName, int> tries_;
  std::vector<Job> jobs_;
  std::size_t cancelled_ = 0;  ///< tasks
  bool began_ = false;         ///< some task has run a cell
  std::string told_;
  Clock::time_point began_looking_ = Clock::now();
  Clock::time_point next_look_ = Clock::now();
  Clock::time_point next_submission_ = Clock::now();
};

}  // namespace

bool run_on_slurm(const std::vector<Cell>& cells, const SlurmOptions& options,
                  const std::function<void(const Cell&, Outcome)>& done) {
  return Follower(cells, options, done).run();
}

void collect_tasks(const fs::path& study, const std::string& key,
                   const std::function<void(const Cell&, Outcome)>& done) {
  for (const Job& job : earlier_jobs(study, key))
    for (const Task& task : job.open)
      if (!is_given_up(job.folder, task.index))
        Journal::read(journal_of(job.folder, task.index), 0, done);
  std::error_code ignored;
  fs::remove_all(tasks_folder(study), ignored);
}

void require_idle(const fs::path& study, bool needed) {
  const SlurmQueue queue(slurm_name(study));
  std::optional<std::vector<QueuedTask>> tasks;
  try {
    tasks = queue.tasks();
    if (!tasks && needed) throw Error(Fault::graph, kNoAnswer);
  } catch (const Error&) {
    if (needed) throw;
  }
  if (!tasks) return;
  const auto alive = std::ranges::count_if(*tasks, [](const auto& task) { return !task.ended(); });
  if (alive == 0) return;
  throw Error(Fault::output, fmt::format("{} tasks of this folder's study wait or run", alive))
      .at(study.string())
      .hint(fmt::format("--engine slurm --resume takes them up, `scancel --name={}` cancels them",
                        queue.name()));
}

}  // namespace velum::study
