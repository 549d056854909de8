// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "graph/diagnostic.hpp"
#include "graph/settings.hpp"
#include "plugins/call.hpp"
#include "run/isolate.hpp"
#include "run/local_context.hpp"
#include "testing/bench.hpp"
#include "velum/testing.hpp"

namespace velum::test {
namespace {

const Parameter& parameter_called(const StageInfo& info, const std::string& name) {
  std::vector<std::string> known;
  for (const Parameter& parameter : info.parameters) {
    const auto& old = parameter.old_names;
    if (parameter.name == name || std::find(old.begin(), old.end(), name) != old.end())
      return parameter;
    known.push_back(parameter.name);
  }
  std::string hint = graph::did_you_mean(name, known);
  if (hint.empty()) hint = graph::known_list(known);
  throw Error(Fault::graph, fmt::format("unknown parameter '{}' of {}", name, info.id)).hint(hint);
}

// What the graph does with a stage whose library may crash.
Results isolated(const plugins::Call& call, run::LocalContext& context, const StageInfo& info) {
  static std::atomic<int> runs = 0;
  const auto scratch = scratch_folder() / fmt::format("isolated-{}", runs++);
  std::filesystem::create_directories(scratch);
  run::IsolatedStage stage;
  stage.id = info.id;
  stage.info = &info;
  stage.plugin = registry().file(info.id);
  stage.seed = context.seed();
  stage.scratch = scratch;
  Results results = run::run_isolated(stage, call, context).results;
  std::filesystem::remove_all(scratch);
  return results;
}

}  // namespace

Stage::Stage(const std::string& id) : type_(&registry().stage(id)) {}

const StageInfo& Stage::info() const {
  return type_->info();
}

Stage& Stage::set(const std::string& name, const std::string& toml) {
  const Parameter& parameter = parameter_called(info(), name);
  settings_[parameter.name] = graph::parse_setting_text(parameter, toml);
  return *this;
}

Stage& Stage::set(const std::string& name, double value) {
  return set(name, fmt::format("{}", value));
}

Stage& Stage::threads(int threads) {
  threads_ = threads;
  return *this;
}

Stage& Stage::seed(std::uint64_t seed) {
  seed_ = seed;
  return *this;
}

Stage& Stage::in(Value value) {
  inputs_.emplace_back().push_back(std::move(value));
  return *this;
}

Stage& Stage::skip() {
  inputs_.emplace_back();
  return *this;
}

Stage& Stage::in_many(std::vector<Value> values) {
  inputs_.push_back(std::move(values));
  return *this;
}

Stage& Stage::cancelled() {
  cancelled_ = true;
  return *this;
}

Outcome Stage::execute() {
  // The inputs are those of this one run.
  const auto call = plugins::prepare(info(), settings_of(info(), settings_, scratch_folder()),
                                     std::exchange(inputs_, {}));
  run::LocalContext context(threads_, run::node_seed(seed_, info().id, "test"));
  if (cancelled_) context.cancel();
  Outcome outcome;
  outcome.results =
      info().isolated ? isolated(call, context, info()) : plugins::invoke(*type_, call, context);
  for (const auto& [name, measure] : context.measures()) outcome.measures[name] = measure.value;
  outcome.warnings = context.warnings();
  return outcome;
}

}  // namespace velum::test
