// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <velum/testing.hpp>

#include "lms511/test_peer.hpp"

/// What the tests of devices.lms511 share: a sweep of a scripted scanner, and how it ended.
namespace lms {

using velum::Cloud;
using velum::Error;
using velum::Fault;
using velum::Index;
using velum::test::Outcome;
using velum::test::Stage;

inline Stage scanner(const Peer& peer, int lines) {
  Stage stage("devices.lms511");
  stage.set("address", peer.address()).set("lines", lines).set("encoding", "cola_b");
  stage.set("tilt", "constant").set("tilt_start", "-0.5 rad").set("tilt_speed", "0.25 rad");
  stage.set("answer_timeout", "2 s").set("silence_timeout", "5 s").set("give_up", "20 s");
  return stage;
}

inline double worst(const Cloud& cloud, const lms::Room& room) {
  double error = 0.0;
  for (Index i = 0; i < cloud.size(); ++i)
    error = std::max(error, room.error(cloud.positions().col(i).cast<double>()));
  return error;
}

inline bool warned(const Outcome& outcome, const std::string& text) {
  return std::any_of(outcome.warnings.begin(), outcome.warnings.end(),
                     [&](const std::string& one) { return one.find(text) != std::string::npos; });
}

// The error of a run that fails.
inline Error failure(Stage stage) {
  try {
    static_cast<void>(stage.run());
  } catch (const Error& error) {
    return error;
  }
  return {Fault::stage, "nothing failed"};
}

inline bool says(const Error& error, const std::string& text) {
  return std::string(error.what()).find(text) != std::string::npos ||
         error.hint().find(text) != std::string::npos;
}

inline constexpr double kMillimetre = 0.0006;

}  // namespace lms
