// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "run/local_context.hpp"
#include "run/record.hpp"

namespace velum::run {

/// A node at work.
struct Running {
  std::string node;
  double fraction = 0.0;  ///< done, 0 to 1; 0 when the stage does not say
  double seconds = 0.0;
};

/// Who is told how a run goes, one call at a time.
class Observer {
 public:
  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer() = default;

  virtual void node_started(const std::string& /*node*/, const std::string& /*stage*/) {}
  virtual void said(const std::string& /*node*/, LocalContext::Level /*level*/,
                    const std::string& /*message*/) {}
  virtual void node_ended(const NodeRecord& /*node*/) {}
  virtual void file_written(const FileRecord& /*file*/) {}
  /// Every 100 ms while nodes run.
  virtual void tick(const std::vector<Running>& /*running*/) {}
};

}  // namespace velum::run
