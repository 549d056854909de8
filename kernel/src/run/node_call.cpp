// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// How a node's results are made.
#include <fmt/format.h>

#include <filesystem>
#include <new>

#include "run/isolate.hpp"
#include "run/node_error.hpp"
#include "run/node_runner.hpp"
#include "run/setting_json.hpp"
#include "run/summary.hpp"
#include "run/threads.hpp"

namespace velum::run {
namespace {

namespace fs = std::filesystem;

template <class Use>
void each_file(const graph::Node& node, ParameterType type, const Use& use) {
  for (std::size_t i = 0; i < node.settings.size(); ++i) {
    if (node.info->parameters[i].type != type) continue;
    const auto& value = node.settings[i].value;
    if (const auto* path = std::get_if<std::string>(&value)) use(i, *path);
  }
}

Json summarise_all(const StageInfo& info, const Results& results) {
  Json out = Json::object();
  for (std::size_t i = 0; i < results.size(); ++i)
    out[info.outputs[i].name] = results[i] ? summarise(*results[i]) : Json(nullptr);
  return out;
}

}  // namespace

void NodeRunner::begin(State& state, int threads) {
  auto context = std::make_shared<LocalContext>(LocalContext::Options{
      .threads = threads,
      .arena = options_.threads,
      .seed =
          node_seed(state.node->seed.value_or(options_.seed), state.node->use, state.node->name),
      .cancel = options_.cancel,
      .log = [this, &state](LocalContext::Level level, const std::string& message) {
        const std::lock_guard observing(observing_);
        observer_.said(state.node->name, level, message);
      }});
  {
    const std::lock_guard lock(mutex_);
    state.overlapped = running_ > 0;
    if (running_++ > 0)
      for (State& other : states_)
        if (other.context) other.overlapped = true;
    state.context = std::move(context);
    state.started = Clock::now();
  }
  const std::lock_guard observing(observing_);
  observer_.node_started(state.node->name, state.node->use);
}

void NodeRunner::end(State& state) {
  const std::lock_guard lock(mutex_);
  --running_;
  if (!abandoned_) {
    state.record.measures = state.context->measures();
    state.record.warnings = state.context->warnings();
  }
  state.context.reset();
}

std::shared_ptr<const Results> NodeRunner::make(State& state, int threads) {
  begin(state, threads);
  struct End {
    NodeRunner& runner;
    State& state;
    ~End() { runner.end(state); }
  } const ended{*this, state};
  try {
    auto results = std::make_shared<const Results>(run_stage(state, threads));
    keep(state, *results);
    show(state, *results);
    hand_over(state, results);
    return results;
  } catch (const Stopped&) {
  } catch (const Cancelled&) {
    const std::lock_guard lock(mutex_);
    state.record.status = Status::interrupted;
  } catch (const Error& error) {
    fail(state, error);
  } catch (const fs::filesystem_error& error) {
    fail(state, Error(Fault::output, error.code().message()).at(error.path1().string()));
  } catch (const std::bad_alloc&) {
    fail(state, Error(Fault::stage, "out of memory"));
  } catch (const std::exception& error) {
    fail(state, Error(Fault::stage, error.what()));
  }
  throw Stopped();
}

Results NodeRunner::run_stage(State& state, int threads) {
  std::vector<Wired> inputs = gather(state, threads);
  state.context->check();
  peak_.mark();
  Timing timing{.started = Clock::now(), .cpu = own_cpu_seconds()};
  Results results;
  try {
    const plugins::Call call = prepare(state, std::move(inputs));
    results = this->call(state, call, timing);
  } catch (...) {
    record_timing(state, timing);
    throw;
  }
  record_timing(state, timing);
  Json out = summarise_all(*state.node->info, results);
  {
    const std::lock_guard lock(mutex_);
    if (abandoned_) throw Cancelled();
    state.record.out = std::move(out);
  }
  check_not_empty(state, results);
  record_files(state);
  const std::lock_guard lock(mutex_);
  if (abandoned_) throw Cancelled();
  state.record.status = Status::ok;
  return results;
}

plugins::Call NodeRunner::prepare(State& state, std::vector<Wired> inputs) {
  const graph::Node& node = *state.node;
  std::vector<Setting> settings = node.settings;
  each_file(node, ParameterType::output_file, [&](std::size_t i, const std::string& path) {
    const fs::path file = (options_.out / path).lexically_normal();
    fs::create_directories(file.parent_path());
    settings[i] = {file.string()};
  });
  plugins::Call call = plugins::prepare(*node.info, std::move(settings), std::move(inputs));
  // Records speak of output files as the graph does.
  std::vector<Setting> said = call.settings;
  each_file(node, ParameterType::output_file,
            [&](std::size_t i, const std::string&) { said[i] = node.settings[i]; });
  Json parameters = to_json(node.info->parameters, said);
  const std::lock_guard lock(mutex_);
  state.record.parameters = std::move(parameters);
  return call;
}

Results NodeRunner::call(State& state, const plugins::Call& call, Timing& timing) {
  const graph::Node& node = *state.node;
  LocalContext& context = *state.context;
  if (!node.isolate) {
    limit_openmp(context.threads());
    return plugins::invoke(registry_.stage(node.use), call, context);
  }
  const fs::path scratch = options_.scratch() / node.name;
  fs::create_directories(scratch);
  IsolatedStage stage{.id = node.use,
                      .info = node.info,
                      .plugin = registry_.file(node.use),
                      .limits = node.limits,
                      .seed = context.seed(),
                      .scratch = scratch};
  IsolatedResults isolated = run_isolated(stage, call, context);
  timing.isolated = {isolated.cpu_seconds, isolated.peak_bytes};
  fs::remove_all(scratch);
  return std::move(isolated.results);
}

void NodeRunner::record_timing(State& state, const Timing& timing) {
  const double cpu = own_cpu_seconds() - timing.cpu;
  const std::uint64_t peak = peak_.since_mark();
  const std::lock_guard lock(mutex_);
  if (abandoned_) return;
  NodeRecord& record = state.record;
  record.seconds = std::chrono::duration<double>(Clock::now() - timing.started).count();
  if (timing.isolated) {
    record.cpu_seconds = timing.isolated->first;
    record.peak_bytes = timing.isolated->second;
  } else if (!state.overlapped && !state.node->isolate) {
    record.cpu_seconds = cpu;
    if (peak > 0) record.peak_bytes = peak;
  }
}

void NodeRunner::check_not_empty(const State& state, const Results& results) {
  if (state.node->allow_empty) return;
  // Further outputs, such as the points that a filter removed, may well be empty.
  if (results.empty() || !results[0] || !is_empty(*results[0])) return;
  const std::string culprit = who_emptied(state);
  std::string message = fmt::format("the {} '{}' is empty", name_of(type_of(*results[0])),
                                    state.node->info->outputs[0].name);
  if (!culprit.empty()) message += ": " + culprit;
  throw CodedError(Fault::stage, kEmptyResult, message,
                   "loosen its parameters, or say `allow_empty = true` in the node");
}

// Follows what is empty up the wires to the stage that was given something and gave nothing.
std::string NodeRunner::who_emptied(const State& state) {
  const std::lock_guard lock(mutex_);
  const State* at = &state;
  while (true) {
    const State* source = nullptr;
    for (const auto& input : at->node->inputs) {
      for (const graph::Wire& wire : input) {
        const State& from = states_[wire.node];
        const Json& given = from.record.out.at(from.node->info->outputs[wire.output].name);
        const double count = given.is_null() ? -1.0 : amount(given);
        if (count > 0.0)
          return fmt::format("'{}' ({}) was given {} and kept nothing", at->node->name,
                             at->node->use, in_words(given));
        if (count == 0.0 && source == nullptr) source = &from;
      }
    }
    if (source == nullptr)
      return fmt::format("'{}' ({}) made nothing", at->node->name, at->node->use);
    at = source;
  }
}

void NodeRunner::record_files(const State& state) {
  each_file(*state.node, ParameterType::output_file, [&](std::size_t, const std::string& path) {
    const fs::path file = (options_.out / path).lexically_normal();
    if (!fs::exists(file)) return;
    FileRecord record = describe_file(file);
    record.path = file.lexically_relative(options_.out).string();
    record.node = state.node->name;
    {
      const std::lock_guard lock(mutex_);
      files_.push_back(record);
    }
    const std::lock_guard observing(observing_);
    observer_.file_written(record);
  });
}

void NodeRunner::keep(State& state, const Results& results) {
  if (state.key.empty()) return;
  CacheEntry entry;
  {
    const std::lock_guard lock(mutex_);
    entry = {state.record.parameters, state.record.out, state.context->measures(),
             state.context->warnings()};
  }
  const std::string problem = options_.cache->store(state.key, entry, results);
  if (problem.empty()) return;
  const std::lock_guard observing(observing_);
  observer_.said(state.node->name, LocalContext::Level::info,
                 "the result could not be kept in the cache: " + problem);
}

}  // namespace velum::run
