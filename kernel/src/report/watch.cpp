// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "report/watch.hpp"

#include <algorithm>
#include <exception>
#include <optional>

#include "report/histogram.hpp"
#include "run/local_context.hpp"

namespace velum::report {
namespace {

/// More outputs than any stage has.
constexpr std::size_t kMostOutputs = 64;

std::optional<std::size_t> place_of(const std::vector<Port>& ports, std::string_view name) {
  const auto found = std::ranges::find(ports, name, &Port::name);
  if (found == ports.end()) return std::nullopt;
  return static_cast<std::size_t>(found - ports.begin());
}

const Cloud* cloud_at(const std::vector<Wired>& inputs, std::optional<std::size_t> port) {
  if (!port || *port >= inputs.size() || inputs[*port].empty()) return nullptr;
  return std::get_if<Cloud>(&inputs[*port].front());
}

/// A stage that moves the cloud `source` to the cloud `target`.
bool registers(const graph::Node& node) {
  return place_of(node.info->inputs, "source") && place_of(node.info->inputs, "target") &&
         place_of(node.info->outputs, "cloud");
}

void add_distances(const graph::Node& node, const std::vector<Wired>& inputs, const Cloud& moved,
                   int threads, View& view) {
  const Cloud* source = cloud_at(inputs, place_of(node.info->inputs, "source"));
  const Cloud* target = cloud_at(inputs, place_of(node.info->inputs, "target"));
  if (source == nullptr || target == nullptr || target->empty()) return;
  run::LocalContext context(threads, 1);
  view.histograms.push_back(distances("distance before", *source, *target, context));
  view.histograms.push_back(distances("distance after", moved, *target, context));
}

}  // namespace

ViewWatch::ViewWatch(const graph::Graph& graph, std::uint64_t limit, int threads,
                     std::set<std::string> only)
    : threads_(threads), only_(std::move(only)), views_(limit) {
  for (const graph::Node& node : graph.nodes) order_.emplace(node.name, order_.size());
}

bool ViewWatch::wants(const graph::Node& node) const {
  return only_.empty() || only_.contains(node.name);
}

bool ViewWatch::wants_inputs(const graph::Node& node) const {
  return registers(node);
}

void ViewWatch::made(const graph::Node& node, const std::vector<Wired>& inputs,
                     const Results& results) {
  // Whatever goes wrong with the report is no failure of the node.
  std::string trouble;
  try {
    look(node, inputs, results);
    return;
  } catch (const std::exception& error) {
    trouble = error.what();
  }
  const std::lock_guard lock(mutex_);
  troubles_.push_back("node '" + node.name + "' is not shown: " + trouble);
}

void ViewWatch::look(const graph::Node& node, const std::vector<Wired>& inputs,
                     const Results& results) {
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i]) continue;
    View view = make_view(*results[i]);
    view.node = node.name;
    view.output = node.info->outputs[i].name;
    view.order = order_.at(node.name) * kMostOutputs + i;
    const auto* cloud = std::get_if<Cloud>(&*results[i]);
    if (cloud != nullptr && view.output == "cloud" && registers(node))
      add_distances(node, inputs, *cloud, threads_, view);
    const std::lock_guard lock(mutex_);
    views_.add(std::move(view));
  }
}

Views ViewWatch::views() const {
  const std::lock_guard lock(mutex_);
  return views_;
}

std::vector<std::string> ViewWatch::troubles() const {
  const std::lock_guard lock(mutex_);
  return troubles_;
}

}  // namespace velum::report
