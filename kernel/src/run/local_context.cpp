// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/local_context.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <xxhash.h>

#include <algorithm>
#include <exception>
#include <thread>

namespace velum::run {
namespace {

// Hands out chunk numbers in ascending order. After an exception no further chunk is begun; as all
// lower ones were begun before, the exception with the lowest number does not depend on threads.
class ChunkQueue {
 public:
  ChunkQueue(const Context& context, Index chunks, const std::function<void(Index)>& body)
      : context_(context), body_(body), chunks_(chunks) {}

  void work() {
    while (!stop_) {
      const Index chunk = next_.fetch_add(1);
      if (chunk >= chunks_) return;
      try {
        context_.check();
        body_(chunk);
      } catch (...) {
        fail(chunk, std::current_exception());
      }
    }
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void fail(Index chunk, std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    if (error_ && failed_ < chunk) return;
    failed_ = chunk;
    error_ = std::move(error);
  }

  const Context& context_;
  const std::function<void(Index)>& body_;
  const Index chunks_;
  std::atomic<Index> next_{0};
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::exception_ptr error_;
  Index failed_ = 0;
};

// The process's oneTBB limit.
class ThreadLimit {
 public:
  static ThreadLimit& instance() {
    static ThreadLimit limit;
    return limit;
  }
  void set(int threads) {
    const std::lock_guard lock(mutex_);
    make(threads);
  }
  // An arena larger than an unset limit, as tests want it on few processors, raises the limit.
  void need(int threads) {
    const std::lock_guard lock(mutex_);
    if (threads > std::max(made_for_need_, default_threads()) &&
        (!control_ || made_for_need_ > 0)) {
      make(threads);
      made_for_need_ = threads;
    }
  }

 private:
  void make(int threads) {
    // The new limit is made after the old one is gone: of several, oneTBB obeys the smallest.
    control_.reset();
    control_ =
        std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(std::max(1, threads)));
  }

  std::mutex mutex_;
  int made_for_need_ = 0;
  std::unique_ptr<tbb::global_control> control_;
};

}  // namespace

struct LocalContext::Arena {
  explicit Arena(int slots) : arena(slots) { ThreadLimit::instance().need(slots); }
  tbb::task_arena arena;
};

void limit_threads(int threads) {
  ThreadLimit::instance().set(threads);
}

int default_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

LocalContext::LocalContext(Options options) : options_(std::move(options)) {
  options_.threads = std::max(1, options_.threads);
  if (options_.arena < 1) options_.arena = options_.threads;
}

LocalContext::LocalContext(int threads, std::uint64_t seed)
    : LocalContext(
          Options{.threads = threads, .arena = 0, .seed = seed, .cancel = nullptr, .log = {}}) {}

LocalContext::~LocalContext() = default;

void LocalContext::progress(double fraction) {
  fraction = std::clamp(fraction, 0.0, 1.0);
  double before = fraction_;
  while (before < fraction && !fraction_.compare_exchange_weak(before, fraction)) {
  }
}

bool LocalContext::cancelled() const noexcept {
  return cancel_.load(std::memory_order_relaxed) ||
         (options_.cancel != nullptr && options_.cancel->load(std::memory_order_relaxed));
}

void LocalContext::warn(const std::string& message) {
  {
    const std::lock_guard lock(mutex_);
    warnings_.push_back(message);
  }
  if (options_.log) options_.log(Level::warning, message);
}

void LocalContext::info(const std::string& message) {
  if (options_.log) options_.log(Level::info, message);
}

void LocalContext::measure(const std::string& name, double value, const std::string& unit,
                           Better better) {
  const std::lock_guard lock(mutex_);
  measures_[name] = {value, unit, better};
}

void LocalContext::run_chunks(Index chunks, const std::function<void(Index chunk)>& body) {
  const Index workers = std::min<Index>(chunks, options_.arena);
  ChunkQueue queue(*this, chunks, body);
  if (workers <= 1) {
    queue.work();
  } else {
    std::call_once(arena_made_, [&] { arena_ = std::make_unique<Arena>(options_.arena); });
    arena_->arena.execute([&] {
      // Isolated: a thread that waits here inside another parallel loop, perhaps holding a lock,
      // must not pick up a chunk of that loop.
      tbb::this_task_arena::isolate([&] {
        tbb::parallel_for(
            Index{0}, workers, [&](Index) { queue.work(); }, tbb::simple_partitioner());
      });
    });
  }
  queue.rethrow();
}

Measures LocalContext::measures() const {
  const std::lock_guard lock(mutex_);
  return measures_;
}

std::vector<std::string> LocalContext::warnings() const {
  const std::lock_guard lock(mutex_);
  return warnings_;
}

std::uint64_t node_seed(std::uint64_t run_seed, const std::string& stage, const std::string& node) {
  const std::string key = stage + '\n' + node;
  return XXH3_64bits_withSeed(key.data(), key.size(), run_seed);
}

}  // namespace velum::run
