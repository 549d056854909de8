// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "emulator/calendar.hpp"
#include "emulator/device.hpp"
#include "lms511/test_tools.hpp"

using namespace velum;
using namespace velum::emulator;
using lms511::Dialect;
using lms511::ErrorCode;
using lms511::Telegram;
using lms511::Writer;

namespace {

constexpr lms511::Mode kMode{2500, 1667, 1};

Device device() {
  return {plain_profile(), kMode};
}
// The answer's text in CoLa A, without its marks.
std::string told(Device& device, Session& session, const std::string& request) {
  session.dialect = Dialect::ascii;
  const std::string frame = answer(device, {Dialect::ascii, request}, session).frame;
  REQUIRE(frame.size() >= 2);
  return frame.substr(1, frame.size() - 2);
}
std::string told(const std::string& request) {
  Device own = device();
  Session session;
  return told(own, session, request);
}
Session logged_in() {
  Session session;
  session.level = 3;
  return session;
}

// The device of the capture, as far as its settings are known.
Profile captured_profile() {
  Profile profile = plain_profile();
  profile.serial = 18110550;
  profile.location = "SN 18110550";
  profile.operating_time = 1085;
  profile.power_ups = 98;
  profile.inputs_changed = 0x5A57EA;
  profile.inputs_changed_at = {.second = 2, .microsecond = 527000};
  profile.outputs_changed = 0x52A3D218;
  profile.outputs_changed_at = {.hour = 1, .minute = 34, .second = 37, .microsecond = 997000};
  constexpr std::array<std::uint32_t, 6> kChanges{141, 299, 199, 148, 4, 4};
  for (std::size_t i = 0; i < kChanges.size(); ++i) profile.outputs[i].changes = kChanges[i];
  auto& fields = profile.fields;
  fields[0] = {.step = 1667,
               .shape = 2,
               .number = 1,
               .corners = {{300, 0xFFFF, 354}, {466, 0xFFFF, 419}, {486, 0xFFFF, 206}},
               .name = "segmented_1"};
  fields[1] = {.step = 1667,
               .shape = 1,
               .number = 2,
               .rectangle = Field::Rectangle{900000, 125, 0, 200, 200},
               .name = "rectangle_field_0_deg"};
  fields[2] = {.step = 1667,
               .shape = 1,
               .number = 3,
               .rectangle = Field::Rectangle{1013099, 127, 450000, 200, 200},
               .name = "rectfield_45_deg"};
  fields[3] = {.step = 1667,
               .shape = 3,
               .number = 4,
               .dynamic = Field::Dynamic{{1800000, 250, 0, 1000, 300}, 2400, 1500},
               .name = "dynamic_field"};
  return profile;
}

std::vector<std::string> frames_of(const std::string& stream) {
  lms511::Framer framer(Dialect::binary);
  std::vector<std::string> frames;
  for (std::size_t at = 0; at < stream.size(); at += 4096) {
    framer.feed(std::string_view(stream).substr(at, 4096));
    while (const auto telegram = framer.next())
      frames.push_back(lms511::framed(Dialect::binary, telegram->payload));
  }
  return frames;
}

}  // namespace

TEST_CASE("the start dialogue of a real LMS 511 is answered byte for byte") {
  const auto asked = lms::capture("20210301_lms511.host.bin");
  const auto answered = lms::capture("20210301_lms511.device.bin");
  if (!asked || !answered) {
    WARN("skipped: no captures (VELUM_SHARED)");
    return;
  }
  std::vector<std::string> real;
  std::string event;
  for (std::string& frame : frames_of(lms::content(*answered))) {
    if (frame.substr(8, 19) == "sSN LIDoutputstate " && event.empty()) event = frame;
    if (frame.substr(8, 3) != "sSN") real.push_back(std::move(frame));
  }
  Device own{captured_profile(), kMode};
  Session session;
  const auto requests = frames_of(lms::content(*asked));
  REQUIRE(requests.size() == 67);
  REQUIRE(real.size() == requests.size());
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const std::string payload = requests[i].substr(8, requests[i].size() - 9);
    INFO("request " << i << ": " << payload.substr(0, 24));
    CHECK(answer(own, {Dialect::binary, payload}, session).frame == real[i]);
  }
  CHECK(session.scans);
  CHECK(outputs_event(own, Dialect::binary) == event);
}

TEST_CASE("the dialogue in CoLa A is that of the listing") {
  Device own = device();
  Session session;
  CHECK(told(own, session, "sMN SetAccessMode 3 F4724744") == "sAN SetAccessMode 1");
  CHECK(told(own, session, "sRN LMPoutputRange") == "sRA LMPoutputRange 1 683 FFFF3CB0 1C3A90");
  CHECK(told(own, session, "sWN LMPoutputRange 1 683 FFFF3CB0 1C3A90") == "sWA LMPoutputRange");
  CHECK(told(own, session, "sWN LMDscandatacfg 01 00 1 0 0 00 00 0 0 0 1 +1") ==
        "sWA LMDscandatacfg");
  CHECK(told(own, session, "sRN LMDscandatacfg") == "sRA LMDscandatacfg 1 0 1 0 0 0 0 0 0 0 1 1");
  CHECK(told(own, session, "sWN FREchoFilter 2") == "sWA FREchoFilter");
  CHECK(told(own, session, "sMN LMCstartmeas") == "sAN LMCstartmeas 0");
  CHECK(told(own, session, "sMN Run") == "sAN Run 1");
  CHECK(told(own, session, "sEN LMDscandata 1") == "sEA LMDscandata 1");
  CHECK(session.scans);
  CHECK(told(own, session, "sEN LMDscandata 0") == "sEA LMDscandata 0");
  CHECK_FALSE(session.scans);
}

TEST_CASE("what the device does not know is answered with the error for its kind") {
  CHECK(told("sRN NoSuchThing") == "sFA 3");
  CHECK(told("sRN field030") == "sFA 3");
  CHECK(told("sWN NoSuchThing 1") == "sFA 3");
  CHECK(told("sMN NoSuchThing") == "sFA 2");
  CHECK(told("sEN NoSuchThing 1") == "sFA F");
  CHECK(told("sXX LMDscandata") == "sFA B");
  CHECK(told("hello") == "sFA B");
  CHECK(told("sRN field029") == "sRA field029 0");
}

TEST_CASE("bad parameters are refused, and change nothing") {
  Device own = device();
  Session session = logged_in();
  CHECK(told(own, session, "sWN LMPoutputRange 1 683 FFFF3CB0") == "sFA 8");
  CHECK(told(own, session, "sWN LMPoutputRange 1 683 -60000 1C3A90") == "sFA 4");
  CHECK(told(own, session, "sWN LMPoutputRange 1 683 zz 1C3A90") == "sFA 11");
  CHECK(told(own, session, "sWN FREchoFilter 3") == "sFA 4");
  CHECK(told(own, session, "sWN FREchoFilter 100") == "sFA 10");
  CHECK(told(own, session, "sWN FREchoFilter 1 1") == "sFA 7");
  CHECK(told(own, session, "sWN FirmwareVersion 1 A") == "sFA A");
  CHECK(told(own, session, "sEN LMDscandata 2") == "sFA 4");
  CHECK(own.range_from == -50000);
  CHECK(own.variables.value("FREchoFilter") == 2);
}

TEST_CASE("only a client that is logged in may configure") {
  Device own = device();
  Session session;
  CHECK(told(own, session, "sWN FREchoFilter 0") == "sFA A");
  CHECK(told(own, session, "sMN mLMPsetscancfg 1388 1 1388 -50000 +1850000") == "sFA 1");
  CHECK(told(own, session, "sMN LMCstartmeas") == "sAN LMCstartmeas 1");
  CHECK(told(own, session, "sMN SetAccessMode 3 12345678") == "sAN SetAccessMode 0");
  CHECK(told(own, session, "sMN SetAccessMode 4 81BE23AA") == "sAN SetAccessMode 1");
  CHECK(told(own, session, "sWN FREchoFilter 0") == "sWA FREchoFilter");
  CHECK(told(own, session, "sMN Run") == "sAN Run 1");  // logs out
  CHECK(told(own, session, "sWN FREchoFilter 1") == "sFA A");
}

TEST_CASE("scan settings: what the device allows becomes valid with Run") {
  Device own = device();
  Session session = logged_in();
  CHECK(told(own, session, "sMN mLMPsetscancfg +10000 +1 +1667 -50000 +1850000") ==
        "sAN mLMPsetscancfg 0 2710 1 683 FFFF3CB0 1C3A90");
  CHECK(told(own, session, "sRN LMPscancfg") == "sRA LMPscancfg 2710 1 683 FFFF3CB0 1C3A90");
  CHECK(own.mode.frequency == 2500);
  const Answer run = answer(own, {Dialect::ascii, "sMN Run"}, session);
  CHECK(run.effect == Effect::speed);
  CHECK(own.mode.frequency == 10000);
  CHECK(own.mode.revolutions == 4);
  session.level = 3;
  const auto status = [&](const std::string& pair) {
    return told(own, session, "sMN mLMPsetscancfg " + pair + " -50000 +1850000").substr(19, 2);
  };
  CHECK(status("+3000 +1 +5000") == "1 ");
  CHECK(status("+3500 +1 +1667") == "2 ");
  CHECK(status("+3000 +1 +1234") == "3 ");
  CHECK(status("+5000 +2 +5000") == "5 ");
  CHECK(told(own, session, "sMN mCLsetscancfglist 5") == "sAN mCLsetscancfglist 0");
  CHECK(told(own, session, "sMN mCLsetscancfglist 40") == "sAN mCLsetscancfglist 1");
}

TEST_CASE("the clock begins in 1970 and can be set") {
  Device own = device();
  Session session = logged_in();
  own.clock = 36e6;
  CHECK(told(own, session, "sRN STlms") == "sRA STlms 7 0 8 00:00:36 A 01.01.1970 0 0 0");
  CHECK(told(own, session, "sMN LSPsetdatetime 7EE 3 11 10 24 36 0") == "sAN LSPsetdatetime 1");
  CHECK(told(own, session, "sRN STlms") == "sRA STlms 7 0 8 16:36:54 A 17.03.2030 0 0 0");
  CHECK(told(own, session, "sMN LSPsetdatetime 7EE D 11 10 24 36 0") == "sFA 4");
  // In CoLa B the answer has 47 bytes.
  CHECK(answer(own, {Dialect::binary, "sRN STlms"}, session).frame.size() == 47 + 9);
  CHECK(told(own, session, "sMN LMCstopmeas") == "sAN LMCstopmeas 0");
  CHECK(told(own, session, "sRN STlms").substr(0, 12) == "sRA STlms 6 ");
}

TEST_CASE("a moment of the calendar and back") {
  for (const double seconds : {0.0, 951782400.5, 1893456000.123, 4102444799.0})
    CHECK(seconds_of(moment_of(seconds)) == Approx(seconds).margin(1.1e-3));
  const lms511::Moment leap = moment_of(951782400.0);
  CHECK((leap.year == 2000 && leap.month == 2 && leap.day == 29));
}

TEST_CASE("every variable can be written and read in both dialects") {
  for (const Dialect dialect : {Dialect::ascii, Dialect::binary}) {
    Device own = device();
    Session session = logged_in();
    Writer write(dialect, "sWN", "TSCTCSrvAddr");
    write.u8(192).u8(168).u8(0).u8(11);
    CHECK(answer(own, {dialect, write.payload()}, session).frame ==
          Writer(dialect, "sWA", "TSCTCSrvAddr").no_parameters().frame());
    CHECK(answer(own, {dialect, "sRN TSCTCSrvAddr"}, session).frame ==
          Writer(dialect, "sRA", "TSCTCSrvAddr").u8(192).u8(168).u8(0).u8(11).frame());
    CHECK(answer(own, {dialect, Writer(dialect, "sWN", "LICencres").f32(0.5F).payload()}, session)
              .frame == Writer(dialect, "sWA", "LICencres").no_parameters().frame());
    CHECK(answer(own, {dialect, "sRN LICencres"}, session).frame ==
          Writer(dialect, "sRA", "LICencres").f32(0.5F).frame());
  }
}

TEST_CASE("a device with a grudge") {
  Device own = device();
  Session session;
  own.grudge.refuse_login = true;
  CHECK(told(own, session, "sMN SetAccessMode 3 F4724744") == "sAN SetAccessMode 0");
  own.grudge.foreign_model = true;
  CHECK(told(own, session, "sRN DeviceIdent").find("TiM") != std::string::npos);
  own.grudge.error = ErrorCode::busy;
  CHECK(told(own, session, "sRN DeviceIdent") == "sFA D");
}
