// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "run/json.hpp"
#include "velum/context.hpp"

namespace velum::study {

enum class Status : std::uint8_t {
  ok,
  failed,         ///< a stage, its data or an output
  empty,          ///< a stage left nothing
  invalid,        ///< a mistake in what this variant says
  crashed,        ///< the process died
  timed_out,      ///< over the study's `timeout`
  out_of_memory,  ///< over its `memory`
};
[[nodiscard]] std::string_view name_of(Status status);

struct Figure {
  double value = 0.0;
  std::string unit;
  Better better = Better::neither;
};

/// How one cell ended.
struct Outcome {
  Status status = Status::failed;
  std::string message;                    ///< why it is not ok, in one line
  std::map<std::string, Figure> figures;  ///< the study's measures, by full name
  /// Hash of what the graph's sources gave: only cells of one source are compared.
  std::string source;
  double seconds = 0.0;
  std::uint64_t peak_bytes = 0;
};

[[nodiscard]] run::Json to_json(const Outcome& outcome);
/// Throws run::Json::exception when it is none.
[[nodiscard]] Outcome outcome_from_json(const run::Json& json);

}  // namespace velum::study
