// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "run/local_context.hpp"
#include "run/record.hpp"
#include "velum/stage.hpp"

namespace velum::graph {
struct Node;
}

namespace velum::run {

/// A node at work.
struct Running {
  std::string node;
  double fraction = 0.0;  ///< done, 0 to 1; 0 when the stage does not say
  double seconds = 0.0;
};

/// Who is told how a run goes, one call at a time.
class Observer {
 public:
  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer() = default;

  virtual void node_started(const std::string& /*node*/, const std::string& /*stage*/) {}
  virtual void said(const std::string& /*node*/, LocalContext::Level /*level*/,
                    const std::string& /*message*/) {}
  virtual void node_ended(const NodeRecord& /*node*/) {}
  virtual void file_written(const FileRecord& /*file*/) {}
  /// Every 100 ms while nodes run.
  virtual void tick(const std::vector<Running>& /*running*/) {}
};

/// Who is shown what nodes have made, also those of which the cache had the results; from several
/// threads at once. Values are dropped when made() returns, unless a node still needs them. Throws
/// nothing.
class Witness {
 public:
  Witness() = default;
  Witness(const Witness&) = delete;
  Witness& operator=(const Witness&) = delete;
  virtual ~Witness() = default;

  /// Should made() be called of this node?
  [[nodiscard]] virtual bool wants(const graph::Node& /*node*/) const { return true; }
  /// Should it be given what the node took, too?
  [[nodiscard]] virtual bool wants_inputs(const graph::Node& /*node*/) const { return false; }
  /// `results` in the order of the node's outputs; `inputs` in that of its inputs, with nothing
  /// where it could not be found again; none unless they are wanted.
  virtual void made(const graph::Node& node, const std::vector<Wired>& inputs,
                    const Results& results) = 0;
};

}  // namespace velum::run
