// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "velum/stage.hpp"

/// For tests of plugins: runs one stage alone, as the kernel would, and the checks that every stage
/// must pass. Plugins are found by VELUM_PLUGIN_PATH, as always.
namespace velum::test {

/// What one run of a stage gave.
struct Outcome {
  Results results;
  std::map<std::string, double> measures;
  std::vector<std::string> warnings;

  /// The result called by its type: the first output of that type. Throws when there is none.
  template <class T>
  [[nodiscard]] const T& get() const {
    for (const auto& result : results)
      if (result && std::holds_alternative<T>(*result)) return std::get<T>(*result);
    throw Error(Fault::stage, "the stage made no " + std::string(name_of(kValueType<T>)));
  }
  [[nodiscard]] const Cloud& cloud() const { return get<Cloud>(); }
  [[nodiscard]] const Mesh& mesh() const { return get<Mesh>(); }
  [[nodiscard]] double measure(const std::string& name) const { return measures.at(name); }
};

/// A stage to be run alone: `Stage("resampling.voxel_grid").set("size", "5 mm").run(cloud)`.
class VELUM_API Stage {
 public:
  explicit Stage(const std::string& id);
  /// A parameter, written as in TOML: "5 mm" needs no quotes, "[0, 0, 1]", "true", "0.05".
  /// Bare lengths are metres. Throws Error as `velum check` would report it.
  Stage& set(const std::string& name, const std::string& toml);
  Stage& set(const std::string& name, const char* toml) { return set(name, std::string(toml)); }
  Stage& set(const std::string& name, double value);
  Stage& threads(int threads);
  Stage& seed(std::uint64_t seed);
  /// The next input, in order; an optional one may be left out at the end, or skipped.
  Stage& in(Value value);
  Stage& skip();
  /// Several values for the next input.
  Stage& in_many(std::vector<Value> values);
  /// Interrupts the run before it starts.
  Stage& cancelled();

  /// Runs with the inputs given by in(), then these. Throws what the kernel would report.
  template <class... V>
  Outcome run(const V&... inputs) {
    (in(Value(inputs)), ...);
    return execute();
  }
  [[nodiscard]] const StageInfo& info() const;

 private:
  Outcome execute();
  const StageType* type_;
  std::map<std::string, Setting> settings_;
  std::vector<Wired> inputs_;
  int threads_ = 2;
  std::uint64_t seed_ = 1;
  bool cancelled_ = false;
};

/// Runs the stage on every degenerate input (0 to 3 points, all equal, collinear, coplanar, 1e7 m
/// away, scaled by 1e-6, cancelled at once), on two instances in two threads, with one seed twice
/// and with 1 and 2 threads. Returns what was broken, one line each: a crash is not caught, any
/// error that is not velum::Error is a fault, and so is a result that is not sound or not the same
/// again. `settings` are those that the stage requires.
VELUM_API std::vector<std::string> conformance(
    const std::string& id, const std::map<std::string, std::string>& settings = {});

}  // namespace velum::test
