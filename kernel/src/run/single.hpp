// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "plugins/registry.hpp"
#include "run/local_context.hpp"

namespace velum::run {

/// Runs one stage without a graph. `settings` are written as in TOML or bare; files are absolute or
/// relative to the working directory. A stage whose library may crash runs in a process of its own,
/// as in a graph. Throws what a run would report.
Results run_single(plugins::Registry& registry, const std::string& stage,
                   const std::map<std::string, std::string>& settings, std::vector<Wired> inputs,
                   LocalContext& context);

}  // namespace velum::run
