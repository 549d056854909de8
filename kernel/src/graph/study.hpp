// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "graph/toml.hpp"

namespace velum::graph {

/// What one variant of a study says differently from its graph.
struct Variation {
  /// The keys that `node` has instead of its own; its `in` stays where `keys` has none. `with` in
  /// them brings helper nodes, which are called "<node>-<helper>" and known to this node only.
  struct Alternative {
    std::string node;
    toml::Node keys;
  };
  /// Another value of one parameter, after the alternatives.
  struct Value {
    std::string node;
    std::string parameter;
    toml::Node value;
  };
  std::vector<Alternative> alternatives;
  std::vector<Value> values;
};

/// One position on an axis.
struct Choice {
  std::string label;  ///< unique on its axis
  Variation variation;
};

struct Axis {
  std::string name;  ///< unique: its title, or what it varies
  std::string zip;   ///< axes of one name go along together; empty: the axis stands for itself
  std::vector<Choice> choices;
};

/// A figure of each run: "fitness" of the node "icp", "seconds" of the whole ("total").
struct MeasureName {
  std::string node;
  std::string name;
  [[nodiscard]] std::string full() const { return node + "." + name; }
  bool operator==(const MeasureName&) const = default;
};

/// Some axes with the label that each has: those that are not named are free.
using Labels = std::map<std::string, std::string>;

/// The [study] of a graph, without mistakes of form.
struct Study {
  std::string title;
  std::vector<std::uint64_t> seeds;  ///< one a repeat; the same in every variant
  std::vector<MeasureName> measures;
  std::vector<Axis> axes;
  std::vector<Labels> exclude;        ///< variants that match one of these are left out
  std::optional<std::size_t> sample;  ///< so many of the variants, chosen at random
  std::optional<Labels> reference;    ///< what variants are compared with, other axes being equal
  bool exclusive = false;             ///< one cell at a time, so that times are not disturbed
  std::optional<double> seconds;      ///< limit of a cell
  std::optional<std::uint64_t> bytes;
};

}  // namespace velum::graph
