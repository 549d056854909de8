// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fstream>

#include "clouds.hpp"
#include "lms511/scan.hpp"
#include "lms511/vrec.hpp"

namespace bench {
namespace {

namespace lms = velum::lms511;
constexpr velum::Index kBeams = 1141;

// A wall with the scanner's noise: ranges and remission that change from beam to beam.
lms::Scan line(std::uint16_t number, velum::Random& random) {
  lms::Scan scan;
  scan.serial = 1;
  scan.telegram_counter = number;
  scan.scan_counter = number;
  scan.start_time = 40000U * number;
  scan.send_time = scan.start_time + 40500;
  scan.scan_frequency = 2500;
  scan.measurement_frequency = 540;
  lms::Channel ranges{.name = "DIST1"};
  lms::Channel remission{.name = "RSSI1"};
  for (velum::Index i = 0; i < kBeams; ++i) {
    ranges.values.push_back(
        static_cast<std::uint16_t>(3000.0 + static_cast<double>(i) + 4.0 * random.gaussian()));
    remission.values.push_back(static_cast<std::uint16_t>(200.0 + 3.0 * random.gaussian()));
  }
  scan.channels16.push_back(std::move(ranges));
  scan.channels8.push_back(std::move(remission));
  return scan;
}

}  // namespace

void write_lines(const std::string& folder, velum::Index count) {
  std::ofstream ascii(folder + "/lines_a.bin", std::ios::binary);
  std::ofstream binary(folder + "/lines_b.bin", std::ios::binary);
  lms::VrecWriter recording(folder + "/lines.vrec", {});
  velum::Random random(7);
  for (velum::Index i = 0; i * kBeams < count; ++i) {
    const lms::Scan scan = line(static_cast<std::uint16_t>(i), random);
    ascii << lms::framed(lms::Dialect::ascii, encode_scan(scan, lms::Dialect::ascii));
    const std::string payload = encode_scan(scan, lms::Dialect::binary);
    binary << lms::framed(lms::Dialect::binary, payload);
    recording.add({lms::Event::binary_telegram, std::int64_t{i} * 40'000'000, payload});
  }
  recording.close();
}

}  // namespace bench
