// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "lms511/scan.hpp"

/// What the tests of the scanner's protocol share.
namespace lms {

/// Bytes from hexadecimal digits; blanks do not count, text between apostrophes stands for itself.
inline std::string bytes(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == ' ') {
      ++i;
    } else if (text[i] == '\'') {
      const std::size_t end = text.find('\'', i + 1);
      result += text.substr(i + 1, end - i - 1);
      i = end + 1;
    } else {
      result += static_cast<char>(std::stoi(std::string(text.substr(i, 2)), nullptr, 16));
      i += 2;
    }
  }
  return result;
}

/// A real capture, or nothing where the captures are not at hand (VELUM_SHARED).
inline std::optional<std::filesystem::path> capture(const std::string& name) {
  const char* shared = std::getenv("VELUM_SHARED");  // NOLINT(concurrency-mt-unsafe)
  if (shared == nullptr) return std::nullopt;
  const auto path = std::filesystem::path(shared) / "data" / "lms511" / name;
  if (!std::filesystem::exists(path)) return std::nullopt;
  return path;
}

inline std::string content(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A scan as a device at 25 Hz and 1/6 degree sends it, with `beams` values that say their number.
inline velum::lms511::Scan sample(std::uint16_t beams = 31, std::uint16_t number = 7) {
  velum::lms511::Scan scan;
  scan.serial = 18110550;
  scan.telegram_counter = number;
  scan.scan_counter = number;
  scan.start_time = 1000000U + 40000U * number;
  scan.send_time = scan.start_time + 40958;
  scan.outputs = {0x3F, 0};
  scan.scan_frequency = 2500;
  scan.measurement_frequency = 540;
  velum::lms511::Channel ranges{.name = "DIST1"};
  velum::lms511::Channel remission{.name = "RSSI1"};
  for (std::uint16_t i = 0; i < beams; ++i) {
    ranges.values.push_back(static_cast<std::uint16_t>(1000 + 10 * i));
    remission.values.push_back(static_cast<std::uint16_t>(255 - i % 200));
  }
  scan.channels16 = {ranges};
  scan.channels8 = {remission};
  scan.time = velum::lms511::Moment{.hour = 1, .minute = 34, .second = 39, .microsecond = 529000};
  return scan;
}

/// Every field in use.
inline velum::lms511::Scan full_sample() {
  velum::lms511::Scan scan = sample();
  scan.polled = true;
  scan.version = 1;
  scan.status = {0, 2};
  scan.inputs = {3, 0};
  scan.encoders = {{4000000000U, 513}, {7, 0}};
  const auto beams = static_cast<std::uint16_t>(scan.channels16.front().values.size());
  for (int echo = 2; echo <= 5; ++echo) {
    velum::lms511::Channel ranges = scan.channels16.front();
    ranges.name.back() = static_cast<char>('0' + echo);
    ranges.values.assign(beams, static_cast<std::uint16_t>(echo * 3));
    scan.channels16.push_back(ranges);
    velum::lms511::Channel remission = scan.channels8.front();
    remission.name.back() = static_cast<char>('0' + echo);
    scan.channels8.push_back(remission);
  }
  scan.channels16.front().values.front() = 65000;
  for (auto* all : {&scan.channels16, &scan.channels8})
    for (auto& channel : *all) {
      channel.scale = 2.0F;
      channel.offset = -12.5F;
      channel.start = -48333;
      channel.step = 3333;
    }
  scan.placement = velum::lms511::Placement{{1.0F, -2.0F, 3.5F, 0.0F, 90.0F, -180.0F}, 1, 0};
  scan.name = "SN 18220118";
  scan.comment = "two  blanks ";
  scan.events = {{"FDIN", 17, 4294967295U, -50000}};
  return scan;
}

}  // namespace lms
