// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <functional>
#include <queue>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "graph/check.hpp"

namespace velum::graph {
namespace {

constexpr std::size_t kMaxCycles = 20;   // reported
constexpr std::size_t kMaxMembers = 12;  // of a cycle that its message names

using Sources = std::vector<std::vector<PlacedWire>>;  // one list a node

Sources sources_of(const Check& check) {
  Sources sources;
  for (const Checked& checked : check.nodes) {
    auto& list = sources.emplace_back();
    for (const auto& input : checked.wires) list.insert(list.end(), input.begin(), input.end());
  }
  return sources;
}

/// Finds cycles by a depth-first search against the wires, without recursion.
class Cycles {
 public:
  Cycles(Check& check, const Sources& sources)
      : check_(check), sources_(sources), state_(sources.size(), State::fresh) {}

  void report() {
    for (std::size_t root = 0; root < sources_.size(); ++root)
      if (state_[root] == State::fresh) search(root);
  }

 private:
  enum class State { fresh, open, done };
  struct Step {
    std::size_t node;
    std::size_t next;  ///< the source to be looked at
  };

  void search(std::size_t root) {
    enter(root);
    while (!path_.empty()) {
      const std::size_t node = path_.back().node;
      if (path_.back().next == sources_[node].size()) {
        state_[node] = State::done;
        path_.pop_back();
        continue;
      }
      const PlacedWire& wire = sources_[node][path_.back().next++];
      if (state_[wire.wire.node] == State::fresh)
        enter(wire.wire.node);
      else if (state_[wire.wire.node] == State::open)
        found(wire);
    }
  }

  void enter(std::size_t node) {
    state_[node] = State::open;
    path_.push_back({node, 0});
  }

  /// The path from where the wire comes from up to now is a cycle.
  void found(const PlacedWire& wire) {
    if (++found_ > kMaxCycles) return;
    const auto begin = std::ranges::find(path_, wire.wire.node, &Step::node);
    // The search goes against the wires: from back to front is along them.
    std::vector<std::string> names{check_.nodes[wire.wire.node].node.name};
    for (auto step = path_.end(); step != begin && names.size() < kMaxMembers;)
      names.push_back(check_.nodes[(--step)->node].node.name);
    if (names.size() == kMaxMembers) names.emplace_back("...");
    Reporter(check_.diagnostics, wire.file->source)
        .error(
            "E0408", wire.where,
            fmt::format("the nodes take from each other in a circle: {}", fmt::join(names, " -> ")),
            "take one of these wires away");
  }

  Check& check_;
  const Sources& sources_;
  std::vector<State> state_;
  std::vector<Step> path_;
  std::size_t found_ = 0;
};

}  // namespace

std::vector<std::size_t> check_order(Check& check) {
  const Sources sources = sources_of(check);
  std::vector<std::size_t> waits(sources.size(), 0);
  std::vector<std::vector<std::size_t>> readers(sources.size());
  for (std::size_t node = 0; node < sources.size(); ++node) {
    waits[node] = sources[node].size();
    for (const PlacedWire& wire : sources[node]) readers[wire.wire.node].push_back(node);
  }
  // Drafts are sorted by name, so the smallest index is the first name.
  std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready;
  for (std::size_t node = 0; node < waits.size(); ++node)
    if (waits[node] == 0) ready.push(node);
  std::vector<std::size_t> order;
  while (!ready.empty()) {
    const std::size_t node = ready.top();
    ready.pop();
    order.push_back(node);
    for (const std::size_t reader : readers[node])
      if (--waits[reader] == 0) ready.push(reader);
  }
  if (order.size() < sources.size()) Cycles(check, sources).report();
  return order;
}

}  // namespace velum::graph
