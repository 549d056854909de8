// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "velum/context.hpp"

namespace velum::run {

/// A figure that a stage gave for the record.
struct Measure {
  double value = 0.0;
  std::string unit;
  Better better = Better::neither;
};
using Measures = std::map<std::string, Measure>;

/// The process's one limit on oneTBB's threads, at least 1. Without a call it is what
/// default_threads() says.
void limit_threads(int threads);
/// Processors that this process may use.
int default_threads();

/// The context of one call of a stage in this process. Collects what the stage says.
class LocalContext : public Context {
 public:
  enum class Level { warning, info };
  using Log = std::function<void(Level, const std::string&)>;
  struct Options {
    /// What the stage is told, for libraries with threads of their own.
    int threads = 1;
    /// Slots of the node's arena; 0: as many as `threads`. Several nodes may have more slots
    /// together than there are threads: oneTBB shares out those of limit_threads().
    int arena = 0;
    /// The node's own seed (see node_seed).
    std::uint64_t seed = 1;
    /// The run's flag, besides that of cancel(); may be null.
    const std::atomic<bool>* cancel = nullptr;
    /// Called at once, from any thread, with what the stage says; may be empty.
    Log log;
  };

  explicit LocalContext(Options options);
  LocalContext(int threads, std::uint64_t seed);
  ~LocalContext() override;

  [[nodiscard]] int threads() const override { return options_.threads; }
  [[nodiscard]] Random random() const override { return Random(options_.seed); }
  void progress(double fraction) override;
  [[nodiscard]] bool cancelled() const noexcept override;
  void warn(const std::string& message) override;
  void info(const std::string& message) override;
  void measure(const std::string& name, double value, const std::string& unit,
               Better better = Better::neither) override;
  void run_chunks(Index chunks, const std::function<void(Index chunk)>& body) override;

  void cancel() { cancel_ = true; }
  [[nodiscard]] std::uint64_t seed() const { return options_.seed; }
  /// What progress() said last, 0 to 1.
  [[nodiscard]] double fraction() const { return fraction_; }
  [[nodiscard]] Measures measures() const;
  [[nodiscard]] std::vector<std::string> warnings() const;

 private:
  Options options_;
  std::atomic<bool> cancel_{false};
  std::atomic<double> fraction_{0.0};
  mutable std::mutex mutex_;
  Measures measures_;
  std::vector<std::string> warnings_;
  struct Arena;  // of oneTBB; made on first use
  std::once_flag arena_made_;
  std::unique_ptr<Arena> arena_;
};

/// The seed of a node's random stream: the same node of the same stage gets the same numbers
/// wherever it stands in the graph.
std::uint64_t node_seed(std::uint64_t run_seed, const std::string& stage, const std::string& node);

}  // namespace velum::run
