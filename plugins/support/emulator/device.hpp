// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "emulator/mirror.hpp"
#include "emulator/profile.hpp"
#include "emulator/variables.hpp"
#include "lms511/frame.hpp"

namespace velum::emulator {

/// What the device knows of one connection.
struct Session {
  lms511::Dialect dialect = lms511::Dialect::binary;
  std::uint8_t level = 0;  ///< of access
  bool scans = false;      ///< subscribed events
  bool outputs = false;
  bool inputs = false;
  bool fields = false;
};

/// What happens besides the answer.
enum class Effect : std::uint8_t {
  none,
  scan,      ///< the answer is the last scan: the caller sends it
  scans_on,  ///< the connection has just subscribed the scans
  outputs_on,
  speed,  ///< the mirror changes its speed
  reboot,
};

/// What an answer is to be spoiled with, for tests of clients.
struct Grudge {
  bool refuse_login = false;
  bool foreign_model = false;
  std::optional<lms511::ErrorCode> error;  ///< every request is answered with it
};

/// The device behind the telegrams: its settings and its clock.
struct Device {
  Profile profile;
  lms511::Mode mode;
  std::optional<lms511::Mode> next_mode{};  ///< becomes valid with Run
  Variables variables{};
  std::int32_t range_from = lms511::kViewFrom;
  std::int32_t range_to = lms511::kViewTo;
  lms511::Dialect host_dialect = lms511::Dialect::binary;  ///< of the host port's next connection
  bool measuring = true;
  bool switched_on = false;  ///< the laser has just been: the next scan has the status 1 0
  double clock = 0.0;        ///< since power-up [us]
  double calendar = 0.0;     ///< seconds of 1970 at power-up
  Grudge grudge{};

  [[nodiscard]] lms511::Moment moment() const;
};

struct Answer {
  std::string frame;
  Effect effect = Effect::none;
};
/// What the device answers. Answers and their order of fields are those of a real LMS 511 with
/// firmware V1.80 where captures show them, else of SICK's listing 8014631.
[[nodiscard]] Answer answer(Device& device, const lms511::Telegram& telegram, Session& session);
/// An LIDoutputstate event.
[[nodiscard]] std::string outputs_event(const Device& device, lms511::Dialect dialect);

}  // namespace velum::emulator
