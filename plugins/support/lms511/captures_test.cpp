// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Every telegram of real captures, with the counts, angles and frequencies that are known of them.
// The captures are not part of this project: the tests skip where VELUM_SHARED does not lead to
// them.
#include <catch2/catch.hpp>
#include <map>

#include "lms511/test_tools.hpp"

using namespace velum::lms511;  // NOLINT

namespace {

struct Seen {
  std::vector<Scan> scans;
  std::map<std::string, int> others;
  Framer::Counts counts;
  ReturnCounts returns;
  std::vector<std::uint16_t> ranges;
};

// Reads all, and checks that each scan is written again as it was.
std::optional<Seen> decoded(const std::string& name) {
  const auto path = lms::capture(name);
  if (!path) {
    WARN("no captures at hand, skipped: " + name);
    return std::nullopt;
  }
  Seen seen;
  Framer framer;
  framer.feed(lms::content(*path));
  while (const auto telegram = framer.next()) {
    Reader reader(*telegram);
    if (!is_scan(reader)) {
      ++seen.others[reader.error() ? in_words(*reader.error())
                                   : std::string(reader.kind()) + " " + std::string(reader.name())];
      continue;
    }
    seen.scans.push_back(decode_scan(reader));
    CHECK(reader.at_end());
    const std::string_view payload = telegram->payload;
    const bool blank = telegram->dialect == Dialect::ascii && payload.back() == ' ';  // a client's
    CHECK(encode_scan(seen.scans.back(), telegram->dialect) ==
          payload.substr(0, payload.size() - (blank ? 1 : 0)));
    const Channel& ranges = seen.scans.back().channels16.front();
    seen.returns.add(ranges);
    for (const auto value : ranges.values)
      if (value >= kLeastRange)
        seen.ranges.push_back(static_cast<std::uint16_t>(static_cast<float>(value) * ranges.scale));
  }
  seen.counts = framer.counts();
  std::sort(seen.ranges.begin(), seen.ranges.end());
  return seen;
}

void check_beams(const Seen& seen, std::uint32_t frequency, std::uint16_t step, std::size_t beams) {
  for (const Scan& scan : seen.scans) {
    CHECK(scan.scan_frequency == frequency);
    CHECK(scan.channels16.front().step == step);
    CHECK(scan.channels16.front().values.size() == beams);
  }
}

}  // namespace

TEST_CASE("an LMS 511 in CoLa B with its start dialogue") {
  const auto seen = decoded("20210301_lms511.device.bin");
  if (!seen) return;
  CHECK(seen->counts.skipped_bytes == 0);
  CHECK(seen->counts.bad_checksums == 0);
  REQUIRE(seen->scans.size() == 136);
  check_beams(*seen, 2500, 1667, 1141);
  CHECK(seen->others.at("sFA 3 (the variable is unknown)") == 18);
  CHECK(seen->others.at("sSN LIDoutputstate") == 4);
  CHECK(seen->others.at("sSN LFErec") == 3);
  CHECK(seen->returns.none == 34);
  CHECK(seen->returns.none + seen->returns.ranges == 155176);
  CHECK(seen->ranges.front() == 282);
  CHECK(seen->ranges.back() == 2921);
  CHECK(seen->ranges.at(seen->ranges.size() / 2) == 1167);
  CHECK_FALSE(seen->scans.front().usable());
  for (std::size_t i = 1; i < seen->scans.size(); ++i) {
    CHECK(seen->scans[i].usable());
    const std::uint32_t step = seen->scans[i].start_time - seen->scans[i - 1].start_time;
    CHECK((step >= 39695 && step < 40225));  // 39.70 to 40.22 ms
  }
  const Scan& second = seen->scans[1];
  CHECK(second.serial == 18110550);
  CHECK(second.telegram_counter == 10204);
  CHECK(second.scan_counter == 10336);
  CHECK(second.channel("DIST1")->values.back() == 628);
  CHECK(second.channel("RSSI1")->values.back() == 214);
  CHECK(second.time == Moment{1970, 1, 1, 1, 34, 39, 529000});
}

TEST_CASE("100 Hz, four interlaced revolutions, CoLa A") {
  const auto seen = decoded("interlaced_100hz_colaa.bin");
  if (!seen) return;
  REQUIRE(seen->scans.size() == 12);
  constexpr std::array<std::int32_t, 4> kStarts = {-50000, -46666, -48333, -44999};
  for (std::size_t i = 0; i < seen->scans.size(); ++i) {
    const Channel& ranges = seen->scans[i].channels16.front();
    CHECK(ranges.start == kStarts.at(i % 4));
    CHECK(ranges.step == 6667);
    CHECK(ranges.values.size() == (i % 4 == 0 ? 286 : 285));
    CHECK(seen->scans[i].scan_frequency == 10000);
  }
  CHECK(seen->returns.none == 0);
  CHECK(seen->ranges.front() == 736);
  CHECK(seen->ranges.back() == 9448);
  CHECK(seen->scans[0].send_time - seen->scans[0].start_time == 11957);
}

TEST_CASE("single scans of other devices in CoLa A") {
  if (const auto seen = decoded("lms511_25hz_rssi_time_colaa.bin")) {
    REQUIRE(seen->scans.size() == 1);
    check_beams(*seen, 2500, 1667, 1141);
    CHECK(seen->scans[0].serial == 20401236);
    CHECK(seen->scans[0].scan_counter == 16142);
    CHECK(seen->returns.none == 722);
    CHECK(seen->ranges.front() == 367);
    CHECK(seen->ranges.back() == 1937);
    CHECK(seen->scans[0].time == Moment{1970, 1, 27, 17, 51, 57, 121000});
  }
  if (const auto seen = decoded("scale2_50hz_colaa.bin")) {
    REQUIRE(seen->scans.size() == 1);
    check_beams(*seen, 5000, 5000, 241);
    CHECK(seen->scans[0].channels16[0].start == 0);
    CHECK(seen->scans[0].channels16[0].scale == 2.0F);
    CHECK(seen->returns.none == 65);
    CHECK(seen->ranges.front() == 1660);
    CHECK(seen->ranges.back() == 63314);
  }
  if (const auto seen = decoded("lms511_5echo_x2_name_time_colaa.bin")) {
    REQUIRE(seen->scans.size() == 1);
    check_beams(*seen, 5000, 5000, 61);
    REQUIRE(seen->scans[0].channels16.size() == 5);
    for (std::size_t echo = 1; echo < 5; ++echo)
      for (const auto value : seen->scans[0].channels16[echo].values) CHECK(value == 0);
    CHECK(seen->scans[0].name == "SL1");
    CHECK(seen->ranges.front() == 1196);
    CHECK(seen->ranges.back() == 1296);
  }
  if (const auto seen = decoded("lms5xx_100hz_181pts_colaa.bin")) {
    REQUIRE(seen->scans.size() == 1);
    check_beams(*seen, 10000, 6667, 181);
    CHECK(seen->scans[0].channels16[0].start == 303333);
    CHECK(seen->ranges.front() == 773);
    CHECK(seen->ranges.back() == 3526);
  }
}

TEST_CASE("a room scanned by a rotating scanner, a telegram a line") {
  const auto seen = decoded("rotating_room_scan.txt");
  if (!seen) return;
  REQUIRE(seen->scans.size() == 883);
  std::map<int, int> steps;
  for (std::size_t i = 0; i < seen->scans.size(); ++i) {
    const Scan& scan = seen->scans[i];
    const Channel& ranges = scan.channels16.front();
    CHECK((ranges.start == -50000 || ranges.start == -48333));
    CHECK(ranges.values.size() == (ranges.start == -50000 ? 571 : 570));
    CHECK(scan.encoders.size() == 1);
    CHECK(scan.name == "SN 18220118");
    if (i > 0)
      ++steps[static_cast<std::uint16_t>(scan.scan_counter - seen->scans[i - 1].scan_counter)];
  }
  CHECK(seen->returns.none == 5486);
  CHECK(seen->returns.none + seen->returns.ranges == 503773);
  CHECK(steps[1] == 766);
  CHECK(steps[2] == 116);
}
