// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace velum::app {

/// What a task of Slurm runs for `velum study --engine slurm`; not for people, and not in --help.
void add_study_task(CLI::App& app);

}  // namespace velum::app
