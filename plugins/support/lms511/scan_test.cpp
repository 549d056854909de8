// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/scan.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "lms511/device.hpp"
#include "lms511/test_tools.hpp"

using lms::bytes;
using namespace velum::lms511;  // NOLINT

namespace {
constexpr double kDegree = std::numbers::pi / 180.0;
}

TEST_CASE("a scan is written as a real LMS 511 wrote it") {
  Scan scan = lms::sample();
  scan.telegram_counter = 10204;
  scan.scan_counter = 10336;
  scan.start_time = 1387999325;
  scan.send_time = 1388040283;
  scan.outputs = {0x31, 0};
  scan.channels16[0].values = {1303, 1299, 1307, 1308};
  scan.channels8[0].values = {254, 254, 208, 212};
  CHECK(
      encode_scan(scan, Dialect::binary) ==
      bytes("'sSN LMDscandata ' 0000 0001 01145856 0000 27DC 2860 52BB305D 52BBD05B 0000 3100 0000 "
            "000009C4 0000021C 0000 0001 'DIST1' 3F800000 00000000 FFFF3CB0 0683 0004 "
            "0517 0513 051B 051C 0001 'RSSI1' 3F800000 00000000 FFFF3CB0 0683 0004 "
            "FE FE D0 D4 0000 0000 0000 0001 07B2 01 01 01 22 27 00081268 0000"));
  CHECK(encode_scan(scan, Dialect::ascii) ==
        "sSN LMDscandata 0 1 1145856 0 0 27DC 2860 52BB305D 52BBD05B 0 0 31 0 0 9C4 21C 0 1 DIST1 "
        "3F800000 00000000 FFFF3CB0 683 4 517 513 51B 51C 1 RSSI1 3F800000 00000000 FFFF3CB0 683 4 "
        "FE FE D0 D4 0 0 0 1 7B2 1 1 1 22 27 81268 0");
}

TEST_CASE("worked telegrams of other devices are read") {
  const std::string encoder =
      "sRA LMDscandata 0 1 1160456 0 0 9506 951E 36B9861E 36B9DCCD 0 0 3F 0 0 1388 21C 1 0 0 1 "
      "DIST1"
      " 3F800000 00000000 FFFF4333 D05 2 981 97C 0 0 1 B SN 18220118 0 1 7B2 1 1 8 24 16 58DE0 0";
  const Scan one = decode_scan({Dialect::ascii, encoder});
  CHECK(one.polled);
  CHECK(one.scan_frequency == 5000);
  CHECK(one.measurement_frequency == 540);
  CHECK(one.encoders == std::vector{EncoderReading{0, 0}});
  CHECK(one.channels16.at(0).start == -48333);
  CHECK(one.channels16.at(0).values == std::vector<std::uint16_t>{2433, 2428});
  CHECK(one.name == "SN 18220118");
  CHECK(one.time == Moment{1970, 1, 1, 8, 36, 22, 364000});
  CHECK(encode_scan(one, Dialect::ascii) == encoder);

  const std::string doubled =
      "sRA LMDscandata 0 1 119FBED 0 0 2B85 329F 4324EDC8 43254982 0 0 3F 0 0 1388 168 0 2 DIST1 "
      "40000000 00000000 AAE60 1388 2 288 280 DIST2 40000000 00000000 AAE60 1388 2 0 0 0 0 1 3 SL1 "
      "0 "
      "1 7E7 6 1C 10 15 30 33C20 0";
  const Scan two = decode_scan({Dialect::ascii, doubled});
  CHECK(two.channels16.at(0).scale == 2.0F);
  CHECK(two.channels16.at(0).start == 700000);
  CHECK(two.channel("DIST1")->values.front() == 648);
  CHECK(two.channel("RSSI1") == nullptr);
  CHECK(two.name == "SL1");
  CHECK(two.time == Moment{2023, 6, 28, 16, 21, 48, 212000});
  CHECK(encode_scan(two, Dialect::ascii) == doubled);
}

TEST_CASE("what is written is read again, in both dialects and with every field in use") {
  for (const Dialect dialect : {Dialect::ascii, Dialect::binary})
    for (const Scan& scan : {lms::sample(), lms::full_sample(), lms::sample(0), Scan()}) {
      const std::string payload = encode_scan(scan, dialect);
      CHECK(decode_scan({dialect, payload}) == scan);
    }
}

TEST_CASE("remission of sixteen bits is found by its name") {
  Scan scan = lms::sample();
  scan.channels16.push_back(scan.channels8.front());
  scan.channels16.back().values.front() = 4000;
  scan.channels8.clear();
  const std::string payload = encode_scan(scan, Dialect::binary);
  CHECK(decode_scan({Dialect::binary, payload}).channel("RSSI1")->values.front() == 4000);
}

TEST_CASE("remission may belong to the neighbouring revolution, as of a polled device") {
  Scan scan = lms::sample();
  scan.channels8.front().start = -48333;
  scan.channels8.front().values.pop_back();
  const std::string payload = encode_scan(scan, Dialect::ascii);
  CHECK(decode_scan({Dialect::ascii, payload}) == scan);
}

TEST_CASE("a telegram may stop behind any flag and have more behind the last") {
  const Scan scan = lms::sample();
  const std::string payload = encode_scan(scan, Dialect::ascii);
  CHECK(decode_scan({Dialect::ascii, payload + " 0 17"}) == scan);
  Scan bare = scan;
  bare.time.reset();
  const std::string text = encode_scan(bare, Dialect::ascii);
  for (std::size_t flags = 1; flags <= 5; ++flags)
    CHECK(decode_scan(
              {Dialect::ascii, std::string_view(text).substr(0, text.size() - 2 * flags)}) == bare);
}

TEST_CASE("a telegram cut anywhere else, or with any byte changed, is read or refused, no more") {
  for (const Dialect dialect : {Dialect::ascii, Dialect::binary}) {
    const std::string payload = encode_scan(lms::full_sample(), dialect);
    const auto attempt = [&](std::string_view changed) {
      try {
        const Scan scan = decode_scan({dialect, changed});
        REQUIRE(scan.channels16.size() <= 10);
      } catch (const Malformed& malformed) {
        REQUIRE(!malformed.where().empty());
      }
    };
    for (std::size_t cut = 0; cut < payload.size(); ++cut) attempt(payload.substr(0, cut));
    for (std::size_t at = 0; at < payload.size(); ++at)
      for (const int other : {0, 1, 2, 0x20, 0x2b, 0x2d, 0x30, 0x46, 0x7f, 0xff}) {
        std::string changed = payload;
        changed[at] = static_cast<char>(other);
        attempt(changed);
      }
  }
}

TEST_CASE("what contradicts itself is refused") {
  const auto refused = [](const Scan& scan) {
    const std::string payload = encode_scan(scan, Dialect::binary);
    CHECK_THROWS_AS(decode_scan({Dialect::binary, payload}), Malformed);
  };
  Scan scan = lms::full_sample();
  scan.channels16.back().values.pop_back();
  refused(scan);
  scan = lms::full_sample();
  scan.channels16.back().start = 0;
  refused(scan);
  scan = lms::sample();
  scan.channels16.front().name = "DIST6";
  refused(scan);
  scan = lms::sample();
  scan.channels16.front().scale = 0.0F;
  refused(scan);
  scan = lms::sample();
  scan.channels16.front().step = scan.channels8.front().step = 0;
  refused(scan);
  scan = lms::sample();
  scan.time->month = 13;
  refused(scan);
  scan = lms::sample();
  scan.encoders.resize(4);
  refused(scan);
}

TEST_CASE("values below 16 are no ranges, each counted by its kind") {
  Channel channel{.name = "DIST1"};
  channel.values = {0, 0, 1, 2, 3, 4, 15, 16, 17, 65535};
  ReturnCounts counts;
  counts.add(channel);
  CHECK(counts ==
        ReturnCounts{.ranges = 3, .none = 2, .dazzled = 1, .implausible = 2, .reserved = 2});
}

TEST_CASE("printed steps and starts mean fractions of a degree") {
  CHECK(true_step(1667) == Approx(kDegree / 6).epsilon(1e-12));
  CHECK(true_step(3333) == Approx(kDegree / 3).epsilon(1e-12));
  CHECK(true_step(6667) == Approx(kDegree * 2 / 3).epsilon(1e-12));
  CHECK(true_step(2500) == Approx(kDegree / 4).epsilon(1e-12));
  CHECK(true_step(833) == Approx(kDegree / 12).epsilon(1e-12));
  CHECK(true_step(417) == Approx(kDegree / 24).epsilon(1e-12));
  CHECK(true_step(10000) == Approx(kDegree).epsilon(1e-12));
  CHECK(true_start(-48333) == Approx(-29.0 / 6.0 * kDegree).epsilon(1e-12));
  CHECK(true_start(-46666) == Approx(-28.0 / 6.0 * kDegree).epsilon(1e-12));
  CHECK(true_start(-44999) == Approx(-4.5 * kDegree).epsilon(1e-12));
  CHECK(true_start(303333) == Approx((30.0 + 1.0 / 3.0) * kDegree).epsilon(1e-12));
  CHECK(true_start(12345) == Approx(1.2345 * kDegree).epsilon(1e-12));
}

TEST_CASE("only the device's pairs of frequency and resolution are modes") {
  CHECK(mode_of(2500, 1667)->revolutions == 1);
  CHECK(mode_of(10000, 1667)->revolutions == 4);
  CHECK(mode_of(5000, 1670)->resolution == 1667);
  CHECK_FALSE(mode_of(3500, 1667));
  CHECK_FALSE(mode_of(2600, 2500));
  CHECK_FALSE(mode_of(2500, 5000));
}

TEST_CASE("the first scan after a start is not to be used") {
  Scan scan = lms::sample();
  CHECK(scan.usable());
  scan.status = {1, 0};
  CHECK_FALSE(scan.usable());
  scan.status = {0, 2};
  CHECK(scan.usable());
  scan.status = {0, 5};
  CHECK_FALSE(scan.usable());
}
