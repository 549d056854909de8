// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/node_runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <new>

#include "run/node_error.hpp"
#include "run/setting_json.hpp"

namespace velum::run {

NodeRunner::NodeRunner(const graph::Graph& graph, plugins::Registry& registry,
                       const ExecuteOptions& options, Observer& observer)
    : registry_(registry), options_(options), observer_(observer), states_(graph.nodes.size()) {
  choose(graph);
  for (const std::size_t node : chosen_) describe(states_[node]);
}

void NodeRunner::choose(const graph::Graph& graph) {
  std::vector<bool> wanted(graph.nodes.size(), options_.only.empty());
  for (const std::string& name : options_.only) wanted.at(graph.find(name).value()) = true;
  // Nodes stand behind their sources, so that one pass from the end reaches all that is needed.
  for (std::size_t node = graph.nodes.size(); node-- > 0;) {
    State& state = states_[node];
    state.node = &graph.nodes[node];
    if (!wanted[node]) continue;
    for (const auto& input : state.node->inputs)
      for (const graph::Wire& wire : input) state.sources.push_back(wire.node);
    std::sort(state.sources.begin(), state.sources.end());
    state.sources.erase(std::unique(state.sources.begin(), state.sources.end()),
                        state.sources.end());
    for (const std::size_t source : state.sources) {
      wanted[source] = true;
      states_[source].readers.push_back(node);
    }
    chosen_.insert(chosen_.begin(), node);
  }
}

void NodeRunner::describe(State& state) {
  const graph::Node& node = *state.node;
  state.readers_left = state.readers.size();
  state.record.name = node.name;
  state.record.use = node.use;
  state.record.version = node.info->version;
  std::string& hash = plugin_hashes_[node.use];
  if (hash.empty()) hash = registry_.file_hash(node.use);
  state.record.plugin_hash = hash;
  state.record.parameters = to_json(node.info->parameters, node.settings);
}

const std::vector<std::size_t>& NodeRunner::readers(std::size_t node) const {
  return states_[node].readers;
}

const std::vector<std::size_t>& NodeRunner::sources(std::size_t node) const {
  return states_[node].sources;
}

Status NodeRunner::status(std::size_t node) {
  const std::lock_guard lock(mutex_);
  return states_[node].record.status;
}

void NodeRunner::run(std::size_t node, int threads) {
  State& state = states_[node];
  const std::lock_guard making(state.making);
  try {
    const auto began = Clock::now();
    bool cached = find_cached(state);
    Cache::Claim claim;
    if (!cached && !state.key.empty()) {
      claim = options_.cache->claim(state.key, options_.cancel);
      cached = claim.waited && find_cached(state);
    }
    if (cached) {
      const std::lock_guard lock(mutex_);
      state.record.seconds = std::chrono::duration<double>(Clock::now() - began).count();
    }
    if (!cached || !show_cached(state)) make(state, threads);
  } catch (const Stopped&) {  // the state tells why
  }
  bool read_by_nobody = false;
  NodeRecord record;
  {
    const std::lock_guard lock(mutex_);
    record = state.record;
    read_by_nobody = state.readers_left == 0;
  }
  if (record.status != Status::cached || read_by_nobody) settle(state);
  const std::lock_guard observing(observing_);
  observer_.node_ended(record);
}

void NodeRunner::skip(std::size_t node) {
  State& state = states_[node];
  settle(state);
  NodeRecord record;
  {
    const std::lock_guard lock(mutex_);
    record = state.record;
  }
  const std::lock_guard observing(observing_);
  observer_.node_ended(record);
}

bool NodeRunner::find_cached(State& state) {
  Json in = describe_inputs(state);
  std::string key;
  try {
    key = make_key(state);
  } catch (const Error& error) {
    fail(state, error);
    throw Stopped();
  }
  const std::lock_guard lock(mutex_);
  state.record.in = std::move(in);
  state.key = key;
  if (key.empty()) return false;
  state.cached = options_.cache->find(key);
  if (!state.cached) return false;
  state.record.status = Status::cached;
  state.record.parameters = state.cached->parameters;
  state.record.out = state.cached->out;
  state.record.measures = state.cached->measures;
  state.record.warnings = state.cached->warnings;
  return true;
}

std::shared_ptr<const Results> NodeRunner::results_of(State& state, int threads) {
  const std::lock_guard making(state.making);
  std::optional<CacheEntry> cached;
  {
    const std::lock_guard lock(mutex_);
    if (state.results) return state.results;
    if (state.record.status == Status::failed || state.record.status == Status::interrupted)
      throw Stopped();
    cached = state.cached;
  }
  if (cached) {
    if (auto loaded = options_.cache->load(state.key, *cached)) {
      auto results = std::make_shared<const Results>(std::move(*loaded));
      hand_over(state, results);
      settle(state);
      return results;
    }
  }
  // What the cache had is damaged: it is made again.
  auto results = make(state, threads);
  settle(state);
  return results;
}

std::vector<Wired> NodeRunner::gather(const State& state, int threads) {
  const graph::Node& node = *state.node;
  std::vector<Wired> inputs(node.inputs.size());
  for (std::size_t port = 0; port < inputs.size(); ++port) {
    for (const graph::Wire& wire : node.inputs[port]) {
      State& source = states_[wire.node];
      const auto& result = results_of(source, threads)->at(wire.output);
      if (result) {
        inputs[port].push_back(*result);
      } else if (node.info->inputs[port].required && !node.info->inputs[port].many) {
        throw Error(Fault::stage, fmt::format("input '{}' got nothing: node '{}' made no '{}'",
                                              node.info->inputs[port].name, source.node->name,
                                              source.node->info->outputs[wire.output].name));
      }
    }
  }
  return inputs;
}

void NodeRunner::hand_over(State& state, std::shared_ptr<const Results> results) {
  const std::lock_guard lock(mutex_);
  state.cached.reset();
  if (state.readers_left > 0) state.results = std::move(results);
}

void NodeRunner::settle(State& state) {
  std::vector<std::shared_ptr<const Results>> dropped;  // freed when the lock is gone
  const std::lock_guard lock(mutex_);
  std::vector<State*> settled = {&state};
  while (!settled.empty()) {
    State& one = *settled.back();
    settled.pop_back();
    if (one.settled) continue;
    one.settled = true;
    for (const std::size_t index : one.sources) {
      State& source = states_[index];
      if (--source.readers_left > 0) continue;
      dropped.push_back(std::move(source.results));
      // Nobody will ask for what the cache has of it, so neither will it for its sources' results.
      if (source.cached) settled.push_back(&source);
    }
  }
}

void NodeRunner::fail(State& state, const Error& error) {
  Failure failure = failure_of(error, state.node->name, state.node->use);
  const std::lock_guard lock(mutex_);
  if (abandoned_) return;
  state.record.status = Status::failed;
  state.record.failure = failure;
  if (!failure_) failure_ = std::move(failure);
}

void NodeRunner::tell_running() {
  std::vector<Running> list;
  {
    const std::lock_guard lock(mutex_);
    list = running();
  }
  const std::lock_guard observing(observing_);
  observer_.tick(list);
}

std::vector<Running> NodeRunner::running() const {
  std::vector<Running> list;
  for (const std::size_t node : chosen_) {
    const State& state = states_[node];
    if (!state.context) continue;
    list.push_back({state.node->name, state.context->fraction(),
                    std::chrono::duration<double>(Clock::now() - state.started).count()});
  }
  return list;
}

RunRecord NodeRunner::record() {
  const std::lock_guard lock(mutex_);
  RunRecord record;
  for (const std::size_t node : chosen_) record.nodes.push_back(states_[node].record);
  record.files = files_;
  std::sort(record.files.begin(), record.files.end(),
            [](const FileRecord& a, const FileRecord& b) { return a.path < b.path; });
  for (const auto& [path, file] : inputs_) record.inputs.push_back(file);
  record.failure = failure_;
  record.peak_bytes = peak_.whole();
  return record;
}

void NodeRunner::abandon() {
  const std::lock_guard lock(mutex_);
  abandoned_ = true;
  for (State& state : states_) {
    if (!state.context) continue;
    state.record.status = Status::interrupted;
    state.record.seconds = std::chrono::duration<double>(Clock::now() - state.started).count();
  }
}

}  // namespace velum::run
