// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "graph/graph.hpp"
#include "plugins/call.hpp"
#include "run/local_context.hpp"

namespace velum::run {

/// A stage to be run in a process of its own.
struct IsolatedStage {
  std::string id;
  const StageInfo* info = nullptr;
  std::filesystem::path plugin;
  graph::Limits limits;
  std::uint64_t seed = 1;         ///< of the node
  std::filesystem::path scratch;  ///< an empty folder for what the processes exchange
};

struct IsolatedResults {
  Results results;
  double cpu_seconds = 0.0;
  std::uint64_t peak_bytes = 0;
};

/// Runs the stage in a fresh process, which is ended when it takes more time or memory than the
/// limits allow or when the run is interrupted. A crash is an Error that names the signal, the last
/// message and the seed. What the stage says goes to `context`.
IsolatedResults run_isolated(const IsolatedStage& stage, const plugins::Call& call,
                             LocalContext& context);

/// The child's side: what the helper program velum-node does with the scratch folder that it is
/// given. Returns its exit status.
int isolated_main(const std::filesystem::path& scratch);

}  // namespace velum::run
