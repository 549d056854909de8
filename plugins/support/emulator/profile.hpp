// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lms511/scan.hpp"

/// A SICK LMS 511 that is not there: what it is (profile), what it answers (device), what its
/// mirror sees (mirror, plate, view), and the server that brings these to its clients.
namespace velum::emulator {

/// An evaluation field, as the variables field000 to field009 hold it: lengths in the device's own
/// unit, angles in 1/10000 degree.
struct Field {
  struct Corner {
    std::uint16_t beam = 0;
    std::uint16_t from = 0xFFFF;
    std::uint16_t to = 0;
  };
  struct Rectangle {
    std::int32_t angle = 0;
    std::uint16_t distance = 0;
    std::int32_t turned = 0;
    std::uint32_t width = 0;
    std::uint32_t length = 0;
  };
  struct Dynamic {
    Rectangle area;
    std::uint16_t speed = 0;
    std::uint32_t stretch = 0;
  };
  std::uint32_t step = 5000;
  std::uint8_t shape = 2;  ///< 1 rectangle, 2 segmented, 3 dynamic
  std::uint8_t number = 0;
  std::vector<Corner> corners{};
  std::optional<Rectangle> rectangle{};
  std::optional<Dynamic> dynamic{};
  std::string name{};

  void write(lms511::Writer& answer) const;
};

/// A digital output: 0 off, 1 on, 2 not there.
struct Output {
  std::uint8_t state = 2;
  std::uint32_t changes = 0;
};

/// Which device it is.
struct Profile {
  std::uint32_t serial = 18000001;
  std::string serial_text = "18000001";
  std::string firmware = "V1.80    ";
  std::string type = "LMS511-20100 PRO";
  std::string ident = "LMS5xx_FieldEval";
  std::string ident_version = "V1.80-01.01.2020";
  std::string order_number = "1046135";
  std::string location = "SN 18000001";
  std::uint32_t operating_time = 1000;  ///< [0.1 h]
  std::uint32_t power_ups = 10;
  std::array<Field, 10> fields{};
  std::array<Output, 14> outputs{};   ///< six of its own, eight external ones
  std::uint32_t outputs_changed = 0;  ///< device clock [us]
  lms511::Moment outputs_changed_at{};
  std::uint32_t inputs_changed = 0;
  lms511::Moment inputs_changed_at{};
};

/// The default profile: outputs of its own off, nothing external.
[[nodiscard]] Profile plain_profile();

}  // namespace velum::emulator
