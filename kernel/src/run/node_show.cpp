// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// What witnesses see of a node.
#include <algorithm>

#include "run/node_runner.hpp"

namespace velum::run {

// False when what the cache has cannot be read: then it has to be made.
bool NodeRunner::show_cached(const State& state) {
  const auto looks = [&](const Witness* witness) { return witness->wants(*state.node); };
  if (std::ranges::none_of(options_.witnesses, looks)) return true;
  std::optional<CacheEntry> entry;
  {
    const std::lock_guard lock(mutex_);
    entry = state.cached;
  }
  const auto results = entry ? options_.cache->load(state.key, *entry) : std::nullopt;
  if (results) show(state, *results);
  return results.has_value();
}

void NodeRunner::show(const State& state, const Results& results) {
  std::vector<Witness*> lookers;
  bool inputs_wanted = false;
  for (Witness* witness : options_.witnesses) {
    if (!witness->wants(*state.node)) continue;
    lookers.push_back(witness);
    inputs_wanted = inputs_wanted || witness->wants_inputs(*state.node);
  }
  std::vector<Wired> inputs;
  if (inputs_wanted) inputs = inputs_again(state);
  for (Witness* witness : lookers) witness->made(*state.node, inputs, results);
}

// Results that are held for this node's sake, or what the cache has: nothing is made for this.
std::vector<Wired> NodeRunner::inputs_again(const State& state) {
  const graph::Node& node = *state.node;
  std::vector<Wired> inputs(node.inputs.size());
  for (std::size_t port = 0; port < inputs.size(); ++port)
    for (const graph::Wire& wire : node.inputs[port]) {
      const State& source = states_[wire.node];
      std::shared_ptr<const Results> results;
      std::string key;
      {
        const std::lock_guard lock(mutex_);
        results = source.results;
        key = source.key;
      }
      if (results == nullptr && !key.empty())
        if (const auto entry = options_.cache->find(key))
          if (auto loaded = options_.cache->load(key, *entry))
            results = std::make_shared<const Results>(std::move(*loaded));
      if (results != nullptr && results->at(wire.output))
        inputs[port].push_back(*results->at(wire.output));
    }
  return inputs;
}

}  // namespace velum::run
