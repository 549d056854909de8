// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lms511/errors.hpp"
#include "lms511/frame.hpp"
#include "velum/random.hpp"

namespace velum::emulator {

/// How the emulator misbehaves, so that clients can be tried.
enum class FaultKind : std::uint8_t {
  none,
  refuse,    ///< logins are refused
  model,     ///< another model and firmware
  error,     ///< every request is answered with sFA
  busy,      ///< a second client is sent away
  silence,   ///< nothing more is said, the connection stays open
  split,     ///< each telegram in two parts, cut at another byte each time
  drip,      ///< a few bytes at a time
  half,      ///< half a telegram, then the connection ends
  length,    ///< every tenth telegram states a wrong length (CoLa B; in CoLa A its end is missing)
  checksum,  ///< every tenth telegram has a wrong byte
  garbage,   ///< random bytes between telegrams
  flood,     ///< hundreds of events between telegrams
  gap,       ///< every tenth telegram is missing
  reset,     ///< the connection is reset
  power_cycle,  ///< all connections end; the device comes back a second later with its clock at 0
};

struct Fault {
  FaultKind kind = FaultKind::none;
  std::uint64_t after = 20;  ///< scans of a connection before it strikes
  lms511::ErrorCode code = lms511::ErrorCode::busy;
};

/// What becomes of one scan on its way.
struct Delivery {
  enum class Then : std::uint8_t { go_on, close, reset, power_cycle };
  std::vector<std::string> pieces;  ///< each is sent by itself
  double pause = 0.0;               ///< between pieces [s]
  Then then = Then::go_on;
};

/// Spoils scan number `number` of a connection; those before fault.after arrive whole. `event` is
/// what floods are made of.
[[nodiscard]] Delivery deliver(const Fault& fault, std::uint64_t number, lms511::Dialect dialect,
                               std::string frame, const std::string& event, Random random);

}  // namespace velum::emulator
