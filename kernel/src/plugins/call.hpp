// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "velum/stage.hpp"

namespace velum::plugins {

/// What a stage is called with: settings and inputs in the order of its description.
struct Call {
  std::vector<Setting> settings;
  std::vector<Wired> inputs;
};

/// Checks the inputs against the ports (number, types, needed columns), brings all of them to the
/// first one's origin and turns relative lengths into metres. Throws Error (Fault::graph) for what
/// `velum check` would have found, Fault::stage for a needed column that is missing.
Call prepare(const StageInfo& info, std::vector<Setting> settings, std::vector<Wired> inputs);

/// Runs the stage. Whatever is thrown leaves as Error or Cancelled, and no longer refers to the
/// plugin. Results that are not those of the ports are an Error (Fault::stage).
Results invoke(const StageType& stage, const Call& call, Context& context);

/// How the results differ from what the stage's outputs promise, or "".
std::string mismatch(const StageInfo& info, const Results& results);

/// Does the rule hold with these settings? Its column is then needed or added.
bool applies(const ColumnRule& rule, const StageInfo& info, const std::vector<Setting>& settings);
/// The points that a value is made of: of a cloud, mesh or clusters; null for others.
const Cloud* points_of(const Value& value);

}  // namespace velum::plugins
