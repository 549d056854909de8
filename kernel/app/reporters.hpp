// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "graph/diagnostic.hpp"
#include "run/run.hpp"

namespace velum::app {

/// Tells the user how a run goes, from its checks to its end.
class Reporter : public run::Observer {
 public:
  /// The graph has mistakes.
  virtual void refused(const graph::Diagnostics& diagnostics) = 0;
  /// The run cannot begin, or its record not be written.
  virtual void refused(const Error& error) = 0;
  virtual void run_started(const run::RunRecord& record, const std::filesystem::path& out) = 0;
  /// Before the run's end is told.
  virtual void report_written(const std::filesystem::path& file) = 0;
  virtual void run_ended(const run::RunResult& result) = 0;
};

/// Lines for people; on a terminal also a bar for each running node. `cached`: the run keeps the
/// results of finished nodes.
std::unique_ptr<Reporter> make_text_reporter(bool on_terminal, bool cached);
/// One JSON object a line (docs/command.md).
std::unique_ptr<Reporter> make_json_reporter();

}  // namespace velum::app
