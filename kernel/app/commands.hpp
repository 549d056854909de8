// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

/// The subcommands of `velum`, one file each. A function adds its subcommand to the command line;
/// the subcommand's callback does the work, prints by console.hpp, and ends with `throw Exit{n}` or
/// an Error where the exit status is not 0.
namespace velum::app {

void add_run(CLI::App& app);
void add_check(CLI::App& app);
void add_study(CLI::App& app);
void add_rerun(CLI::App& app);
void add_report(CLI::App& app);
void add_list(CLI::App& app);
void add_describe(CLI::App& app);
void add_schema(CLI::App& app);
void add_new(CLI::App& app);
void add_convert(CLI::App& app);
void add_info(CLI::App& app);
void add_record(CLI::App& app);
void add_emulate(CLI::App& app);

/// The exit status of a subcommand that has said what there is to say.
struct Exit {
  int status;
};

}  // namespace velum::app
