// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "velum/error.hpp"

/// What the command says, and where. Standard output is the command's alone: file descriptor 1 is
/// pointed at standard error before any plugin is opened, so that what a library prints there
/// cannot get between the lines of a result.
namespace velum::app {

/// Called once, first of all.
void take_standard_output();
/// To the true standard output. What cannot be written there is lost; check_output tells.
void print(std::string_view text);
/// Throws Error (Fault::output) when something could not be printed, but for a pipe whose reader
/// has left.
void check_output();
/// Is the true standard output a terminal?
bool on_terminal();
/// To standard error.
void complain(std::string_view text);

/// An error in the form that all commands use:
///     error: what was found, what was expected
///       at scan.pcd:12
///       the fix
std::string format(const Error& error);

}  // namespace velum::app
