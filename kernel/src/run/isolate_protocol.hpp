// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

/// What a run and the process of an isolated stage exchange in the node's scratch folder.
namespace velum::run {

inline constexpr const char* kCall = "call.json";  ///< stage, settings, how many values an input
inline constexpr const char* kInputs = "inputs.flat";  ///< the values of all inputs, in order
inline constexpr const char* kAnswer = "answer.json";  ///< measures; the error, if there is one
inline constexpr const char* kOutputs = "outputs.flat";

/// Descriptor on which the child says how it goes: one JSON object a line.
inline constexpr int kMessages = 3;

}  // namespace velum::run
