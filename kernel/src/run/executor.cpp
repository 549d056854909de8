// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/executor.hpp"

#include <algorithm>

#include "run/threads.hpp"

namespace velum::run {
namespace {

constexpr std::chrono::milliseconds kTick{100};

}  // namespace

Executor::Executor(const graph::Graph& graph, plugins::Registry& registry, ExecuteOptions options,
                   Observer& observer)
    : options_(std::move(options)),
      nodes_(graph, registry, options_, observer),
      waiting_(graph.nodes.size()),
      dropped_(graph.nodes.size()) {
  limit_threads(options_.threads);
  find_openmp();
  for (const std::size_t node : nodes_.chosen()) {
    waiting_[node] = nodes_.sources(node).size();
    if (waiting_[node] == 0) ready_.insert(node);
  }
}

Executor::~Executor() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  work_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

bool Executor::cancelled() const {
  return options_.cancel != nullptr && options_.cancel->load();
}

// Called with the lock held. There are at most as many nodes at work as threads.
void Executor::call_workers() {
  const auto most = static_cast<std::size_t>(std::max(1, options_.threads));
  for (std::size_t woken = 0; woken < ready_.size(); ++woken) {
    if (woken < idle_) {
      work_.notify_one();
    } else if (workers_.size() < most) {
      workers_.emplace_back([this] { work(); });
    } else {
      return;
    }
  }
}

void Executor::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    ++idle_;
    work_.wait(lock, [this] { return over_ || (!ready_.empty() && !cancelled()); });
    --idle_;
    if (over_) return;
    const std::size_t node = *ready_.begin();
    ready_.erase(ready_.begin());
    ++busy_;
    // What is at work and what could be share the threads; results do not depend on how.
    const auto sharing = static_cast<int>(busy_ + ready_.size());
    lock.unlock();
    nodes_.run(node, std::max(1, options_.threads / sharing));
    const Status status = nodes_.status(node);
    lock.lock();
    const auto skipped = finish(node, status);
    if (!skipped.empty()) {
      lock.unlock();
      for (const std::size_t each : skipped) nodes_.skip(each);
      lock.lock();
    }
    --busy_;
    if (is_over()) {
      watch_.notify_all();
    } else if (ready_.size() > 1) {
      call_workers();  // this one takes the first itself
    }
  }
}

// Makes ready what waited for this node only; returns what cannot run any more.
std::vector<std::size_t> Executor::finish(std::size_t node, Status status) {
  const bool well = status == Status::ok || status == Status::cached;
  std::vector<std::size_t> skipped;
  std::vector<std::size_t> ended = {node};
  dropped_[node] = !well;
  while (!ended.empty()) {
    const std::size_t one = ended.back();
    ended.pop_back();
    for (const std::size_t reader : nodes_.readers(one)) {
      if (dropped_[reader]) continue;
      if (!dropped_[one]) {
        if (--waiting_[reader] == 0) ready_.insert(reader);
        continue;
      }
      dropped_[reader] = true;
      skipped.push_back(reader);
      ended.push_back(reader);
    }
  }
  std::sort(skipped.begin(), skipped.end());
  return skipped;
}

Ended Executor::watch(std::unique_lock<std::mutex>& lock) {
  std::optional<Clock::time_point> interrupted;
  while (!watch_.wait_for(lock, kTick, [this] { return is_over(); })) {
    if (cancelled() && !interrupted) interrupted = Clock::now();
    if (interrupted && Clock::now() - *interrupted > kPatience) {
      nodes_.abandon();
      return Ended::abandoned;
    }
    lock.unlock();
    nodes_.tell_running();
    lock.lock();
  }
  return cancelled() ? Ended::interrupted : Ended::done;
}

Ended Executor::run() {
  std::unique_lock lock(mutex_);
  call_workers();
  return watch(lock);
}

}  // namespace velum::run
