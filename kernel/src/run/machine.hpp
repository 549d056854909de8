// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "run/json.hpp"

namespace velum::run {

/// Processor, cores, instruction set, operating system, kernel and memory, for the record.
Json machine();
/// The vector instructions that code chosen at run time may use here: results are the same bytes on
/// one instruction set. "x86-64 sse4.2 avx2 fma"
std::string instruction_set();

}  // namespace velum::run
