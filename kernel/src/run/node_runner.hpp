// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "graph/graph.hpp"
#include "plugins/call.hpp"
#include "plugins/registry.hpp"
#include "run/cache.hpp"
#include "run/observer.hpp"
#include "run/record.hpp"
#include "run/usage.hpp"

namespace velum::run {

struct ExecuteOptions {
  std::filesystem::path out;  ///< where output files go; absolute
  /// A folder for what isolated nodes exchange with this process; asked for when one runs.
  std::function<std::filesystem::path()> scratch;
  int threads = 1;
  std::uint64_t seed = 1;
  std::vector<std::string> only;  ///< with what they need; empty: every node
  Cache* cache = nullptr;
  const std::atomic<bool>* cancel = nullptr;
  std::vector<Witness*> witnesses;
};

/// The nodes of one run: what each takes, makes, and what is recorded of it. Says nothing of when
/// they run: that is the Executor's. All methods may be called from several threads.
class NodeRunner {
 public:
  NodeRunner(const graph::Graph& graph, plugins::Registry& registry, const ExecuteOptions& options,
             Observer& observer);

  /// The nodes that run, in the graph's order.
  [[nodiscard]] const std::vector<std::size_t>& chosen() const { return chosen_; }
  /// The chosen nodes that take from `node` / that it takes from, each once.
  [[nodiscard]] const std::vector<std::size_t>& readers(std::size_t node) const;
  [[nodiscard]] const std::vector<std::size_t>& sources(std::size_t node) const;

  /// Runs a node whose sources have ended well, or finds its results in the cache; `threads` is
  /// what libraries with threads of their own may use. The node's status tells how it went.
  void run(std::size_t node, int threads);
  void skip(std::size_t node);
  [[nodiscard]] Status status(std::size_t node);

  /// Tells the observer which nodes are at work.
  void tell_running();
  [[nodiscard]] RunRecord record();
  /// To be called before a record of an abandoned run is made: what runs now counts as interrupted.
  void abandon();

 private:
  using Clock = std::chrono::steady_clock;

  struct State {
    const graph::Node* node = nullptr;
    std::vector<std::size_t> sources;
    std::vector<std::size_t> readers;
    std::mutex making;  ///< held while results are made or read from the cache
    // Below: under mutex_.
    NodeRecord record;
    std::string key;                   ///< of the cache; empty: not to be cached
    std::optional<CacheEntry> cached;  ///< there, and not read yet
    std::shared_ptr<const Results> results;
    std::size_t readers_left = 0;
    bool settled = false;                   ///< does not need its sources' results any more
    std::shared_ptr<LocalContext> context;  ///< while it runs
    Clock::time_point started;
    bool overlapped = false;
  };

  struct Timing {
    Clock::time_point started;
    double cpu = 0.0;  ///< of the process, when the node started [s]
    /// Processor time [s] and peak memory of the node's own process.
    std::optional<std::pair<double, std::uint64_t>> isolated = std::nullopt;
  };

  // node_runner.cpp: what is there, and who still needs it
  void choose(const graph::Graph& graph);
  void describe(State& state);
  bool find_cached(State& state);
  std::shared_ptr<const Results> results_of(State& state, int threads);
  std::vector<Wired> gather(const State& state, int threads);
  void hand_over(State& state, std::shared_ptr<const Results> results);
  void settle(State& state);
  void fail(State& state, const Error& error);
  [[nodiscard]] std::vector<Running> running() const;

  // node_call.cpp: making results; without them, Stopped is thrown
  std::shared_ptr<const Results> make(State& state, int threads);
  void begin(State& state, int threads);
  void end(State& state);
  Results run_stage(State& state, int threads);
  plugins::Call prepare(State& state, std::vector<Wired> inputs);
  Results call(State& state, const plugins::Call& call, Timing& timing);
  void record_timing(State& state, const Timing& timing);
  void check_not_empty(const State& state, const Results& results);
  std::string who_emptied(const State& state);
  void record_files(const State& state);
  void keep(State& state, const Results& results);

  // node_show.cpp: what witnesses see
  bool show_cached(const State& state);
  void show(const State& state, const Results& results);
  std::vector<Wired> inputs_again(const State& state);

  // node_key.cpp: what results depend on
  Json describe_inputs(const State& state);
  std::string make_key(const State& state);
  FileRecord input_file(const std::string& path);

  plugins::Registry& registry_;
  const ExecuteOptions& options_;
  Observer& observer_;
  std::deque<State> states_;  ///< one a node of the graph; those not chosen stay empty
  std::vector<std::size_t> chosen_;
  std::map<std::string, std::string> plugin_hashes_;
  PeakMeter peak_;

  std::mutex mutex_;
  std::mutex observing_;
  std::mutex reading_;
  std::map<std::string, FileRecord> inputs_;
  std::vector<FileRecord> files_;
  std::optional<Failure> failure_;
  std::size_t running_ = 0;
  bool abandoned_ = false;
};

}  // namespace velum::run
