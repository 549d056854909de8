// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/pool.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <chrono>
#include <list>

namespace velum::study {
namespace {

using Clock = std::chrono::steady_clock;

/// Limits are looked at so often; the end of a process is seen at once.
constexpr int kLookMs = 50;
/// More than a run takes to stop by itself (run::kPatience) and write its record.
constexpr std::chrono::milliseconds kPatience{2500};

class Pool {
 public:
  Pool(const std::vector<Cell>& cells, const PoolOptions& options,
       const std::function<Process(const Cell&)>& start,
       const std::function<void(const Cell&, Outcome)>& done)
      : cells_(cells), options_(options), start_(start), done_(done) {}

  bool run() {
    while (!cancelled() && (next_ < cells_.size() || !running_.empty())) {
      while (next_ < cells_.size() && running_.size() < static_cast<std::size_t>(options_.jobs)) {
        running_.push_back({cells_[next_], start_(cells_[next_])});
        ++next_;
      }
      wait();
      collect();
      check_limits();
    }
    if (cancelled()) stop();
    return known_ == cells_.size();
  }

 private:
  struct Running {
    Cell cell;
    Process process;
  };

  [[nodiscard]] bool cancelled() const { return options_.cancel != nullptr && *options_.cancel; }

  void wait() const {
    std::vector<pollfd> ends;
    for (const Running& running : running_) ends.push_back({running.process.ended(), POLLIN, 0});
    ::poll(ends.data(), ends.size(), kLookMs);
  }

  void collect() {
    for (auto running = running_.begin(); running != running_.end();) {
      pollfd end = {running->process.ended(), POLLIN, 0};
      if (::poll(&end, 1, 0) <= 0) {
        ++running;
        continue;
      }
      Outcome outcome = running->process.outcome();
      // A cell that has no answer to give because the study is interrupted is no cell that crashed.
      if (!cancelled() || outcome.status != Status::crashed)
        tell(running->cell, std::move(outcome));
      running = running_.erase(running);
    }
  }

  void tell(const Cell& cell, Outcome outcome) {
    ++known_;
    done_(cell, std::move(outcome));
  }

  void check_limits() {
    for (auto running = running_.begin(); running != running_.end();) {
      const auto reason = over_limit(running->process);
      if (!reason) {
        ++running;
        continue;
      }
      running->process.kill();
      tell(running->cell, *reason);
      running = running_.erase(running);
    }
  }

  [[nodiscard]] std::optional<Outcome> over_limit(const Process& process) const {
    Outcome outcome;
    outcome.seconds = process.seconds();
    if (options_.seconds && outcome.seconds > *options_.seconds) {
      outcome.status = Status::timed_out;
      outcome.message = fmt::format("took more than the limit of {} s", *options_.seconds);
      return outcome;
    }
    if (!options_.bytes) return std::nullopt;
    outcome.peak_bytes = process.resident();
    if (outcome.peak_bytes <= *options_.bytes) return std::nullopt;
    outcome.status = Status::out_of_memory;
    outcome.message =
        fmt::format("took more than the limit of {} MB of memory", *options_.bytes / 1'000'000);
    return outcome;
  }

  void stop() {
    for (const Running& running : running_) running.process.interrupt();
    const auto until = Clock::now() + kPatience;
    while (!running_.empty() && Clock::now() < until) {
      wait();
      collect();
    }
    for (const Running& running : running_) running.process.kill();
    running_.clear();
  }

  const std::vector<Cell>& cells_;
  const PoolOptions& options_;
  const std::function<Process(const Cell&)>& start_;
  const std::function<void(const Cell&, Outcome)>& done_;
  std::size_t next_ = 0;
  std::size_t known_ = 0;  ///< cells whose outcome was told
  std::list<Running> running_;
};

}  // namespace

bool run_cells(const std::vector<Cell>& cells, const PoolOptions& options,
               const std::function<Process(const Cell&)>& start,
               const std::function<void(const Cell&, Outcome)>& done) {
  return Pool(cells, options, start, done).run();
}

}  // namespace velum::study
