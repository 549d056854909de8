// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "lms511/device.hpp"
#include "lms511/test_tools.hpp"

using lms::bytes;
using namespace velum::lms511;  // NOLINT

namespace {

std::vector<std::string> payloads(Framer& framer, std::string_view stream) {
  std::vector<std::string> all;
  framer.feed(stream);
  while (const auto telegram = framer.next()) all.emplace_back(telegram->payload);
  return all;
}

}  // namespace

// The start dialogue of a real device, byte for byte.
TEST_CASE("requests and answers are written as a real device and its client wrote them") {
  const auto binary = [](const char* kind, const char* name) {
    return Writer(Dialect::binary, kind, name);
  };
  CHECK(binary("sMN", "SetAccessMode").u8(3).u32(0xF4724744).frame() ==
        bytes("02020202 00000017 'sMN SetAccessMode ' 03 F4724744 B3"));
  CHECK(binary("sAN", "SetAccessMode").u8(1).frame() ==
        bytes("02020202 00000013 'sAN SetAccessMode ' 01 38"));
  CHECK(binary("sWN", "EIHstCola").u8(1).frame() ==
        bytes("02020202 0000000F 'sWN EIHstCola ' 01 09"));
  CHECK(binary("sWA", "EIHstCola").no_parameters().frame() ==
        bytes("02020202 0000000E 'sWA EIHstCola ' 07"));
  CHECK(binary("sRN", "FirmwareVersion").frame() ==
        bytes("02020202 00000013 'sRN FirmwareVersion' 24"));
  CHECK(binary("sRA", "FirmwareVersion").text16("V1.80    ").frame() ==
        bytes("02020202 0000001F 'sRA FirmwareVersion ' 0009 'V1.80    ' 43"));
  CHECK(binary("sRA", "ODoprh").u32(0x43D).frame() ==
        bytes("02020202 0000000F 'sRA ODoprh ' 0000043D 57"));
  CHECK(binary("sWN", "LMPoutputRange").u16(1).u32(0x683).i32(-50000).i32(1850000).frame() ==
        bytes("02020202 00000021 'sWN LMPoutputRange ' 0001 00000683 FFFF3CB0 001C3A90 C5"));
  CHECK(binary("sMN", "Run").frame() == bytes("02020202 00000007 'sMN Run' 19"));
  CHECK(error_frame(Dialect::binary, ErrorCode::variable_unknown) ==
        bytes("02020202 00000005 73 46 41 00 03 77"));
  CHECK(error_frame(Dialect::ascii, ErrorCode::variable_unknown) == bytes("02 'sFA 3' 03"));
  CHECK(error_frame(Dialect::ascii, ErrorCode::complex_arrays) == bytes("02 'sFA 1A' 03"));
  CHECK(Writer(Dialect::ascii, "sWN", "LMPoutputRange")
            .u16(1)
            .u32(0x683)
            .i32(-50000)
            .i32(1850000)
            .frame() == bytes("02 'sWN LMPoutputRange 1 683 FFFF3CB0 1C3A90' 03"));
  CHECK(Writer(Dialect::ascii, "sRA", "DeviceIdent")
            .text16("LMS10x_FieldEval")
            .text16("V1.36-21.10.2010")
            .payload() == "sRA DeviceIdent 10 LMS10x_FieldEval 10 V1.36-21.10.2010");
}

TEST_CASE("an event is read field by field") {
  const std::string frame = bytes(
      "02020202 0000006C 'sSN LIDoutputstate ' 0000 52A3D218 00 0000008D 00 0000012B 00 000000C7 "
      "00 00000094 00 00000004 00 00000004 02 00000000 02 00000000 02 00000000 02 00000000 "
      "02 00000000 02 00000000 02 00000000 02 00000000 0001 07B2 01 01 01 22 25 000F3688 8B");
  REQUIRE(frame.size() == 117);
  Framer framer;
  framer.feed(frame);
  const auto telegram = framer.next();
  REQUIRE(telegram);
  Reader reader(*telegram);
  CHECK(reader.kind() == "sSN");
  CHECK(reader.name() == "LIDoutputstate");
  CHECK(reader.u16() == 0);
  CHECK(reader.u32() == 1386467864U);
  CHECK(reader.u8() == 0);
  CHECK(reader.u32() == 141);
}

TEST_CASE("requests may have decimal numbers behind a sign, and leading zeros") {
  const std::string payload = "sMN mLMPsetscancfg +2500 +1 +1667 -50000 +1850000";
  Reader reader({Dialect::ascii, payload});
  CHECK(reader.u32() == 2500);
  CHECK(reader.i16() == 1);
  CHECK(reader.u32() == 1667);
  CHECK(reader.i32() == -50000);
  CHECK(reader.i32() == 1850000);
  CHECK(reader.at_end());
  Reader login({Dialect::ascii, "sMN SetAccessMode 03 F4724744"});
  CHECK(login.u8() == 3);
  CHECK(login.u32() == kAuthorisedClient.hash);
}

TEST_CASE("what does not fit is refused with the code that a device answers") {
  const auto code = [](std::string_view text, auto&& read) {
    try {
      Reader reader({Dialect::ascii, text});
      read(reader);
    } catch (const Malformed& malformed) {
      CHECK(malformed.fault() == velum::Fault::input);
      return malformed.code();
    }
    return ErrorCode::none;
  };
  const auto u8 = [](Reader& reader) { static_cast<void>(reader.u8()); };
  CHECK(code("sWN EIHstCola", u8) == ErrorCode::too_few_parameters);
  CHECK(code("sWN EIHstCola 100", u8) == ErrorCode::overflow);
  CHECK(code("sWN EIHstCola +256", u8) == ErrorCode::overflow);
  CHECK(code("sWN EIHstCola 1x", u8) == ErrorCode::invalid_character);
  CHECK(code("sWN EIHstCola +", u8) == ErrorCode::invalid_character);
  CHECK(code("sWN", u8) == ErrorCode::kind_unknown);
  CHECK(code("xWN EIHstCola 1", u8) == ErrorCode::kind_unknown);
  CHECK(code("sWN  1", u8) == ErrorCode::command_unknown);
}

TEST_CASE("every error code has a meaning") {
  CHECK(in_words(ErrorCode::variable_unknown) == "sFA 3 (the variable is unknown)");
  for (unsigned code = 0; code <= 0x1A; ++code)
    CHECK(meaning(static_cast<ErrorCode>(code)) != "a code that is not listed");
  CHECK(in_words(static_cast<ErrorCode>(0x99)) == "sFA 99 (a code that is not listed)");
}

TEST_CASE("a stream cut at every byte gives the same telegrams") {
  for (const Dialect dialect : {Dialect::ascii, Dialect::binary}) {
    const std::string one = encode_scan(lms::sample(5), dialect);
    const std::string two = Writer(dialect, "sEA", "LMDscandata").u8(1).payload();
    const std::string stream = framed(dialect, one) + framed(dialect, two);
    for (std::size_t cut = 0; cut <= stream.size(); ++cut) {
      Framer framer(dialect);
      auto all = payloads(framer, stream.substr(0, cut));
      for (auto& more : payloads(framer, stream.substr(cut))) all.push_back(std::move(more));
      REQUIRE(all == std::vector{one, two});
      REQUIRE(framer.counts().skipped_bytes == 0);
    }
    Framer drip;
    std::vector<std::string> all;
    for (const char c : stream)
      for (auto& more : payloads(drip, {&c, 1})) all.push_back(std::move(more));
    CHECK(all == std::vector{one, two});
  }
}

TEST_CASE("garbage between telegrams is skipped and counted") {
  for (const Dialect dialect : {Dialect::ascii, Dialect::binary}) {
    const std::string payload = encode_scan(lms::sample(5), dialect);
    for (const std::string& garbage :
         {std::string("noise"), std::string(3, '\x02'), std::string("\x02\x02sS\x03", 5),
          std::string("\x02sSN LMD"), std::string("\x00\xff\x03", 3), std::string(70, 's')}) {
      for (const bool known : {true, false}) {
        if (!known && dialect == Dialect::ascii && garbage == "\x02\x02\x02") continue;
        Framer framer(known ? std::optional(dialect) : std::nullopt);
        const auto all = payloads(
            framer, garbage + framed(dialect, payload) + garbage + framed(dialect, payload));
        CHECK(all == std::vector{payload, payload});
        CHECK(framer.counts().skipped_bytes == 2 * garbage.size());
      }
    }
  }
}

TEST_CASE("CoLa B: a byte that changed anywhere costs that telegram and no other") {
  const std::string good = encode_scan(lms::sample(20, 8), Dialect::binary);
  const std::string bad = framed(Dialect::binary, encode_scan(lms::sample(20, 9), Dialect::binary));
  std::string crowd;
  while (crowd.size() < kLongestTelegram + 1000) crowd += framed(Dialect::binary, good);
  const std::string little = framed(Dialect::binary, good);
  for (std::size_t at = 0; at < bad.size(); ++at) {
    for (const unsigned flip : {0x01U, 0x80U, 0xffU, static_cast<unsigned>(bad[at] ^ 0x02)}) {
      if (static_cast<std::uint8_t>(flip) == 0) continue;
      std::string changed = bad;
      changed[at] = static_cast<char>(changed[at] ^ static_cast<char>(flip));
      const bool length = at >= 4 && at < 8;  // more bytes may be awaited
      Framer framer(Dialect::binary);
      std::size_t count = 0;
      framer.feed(changed + (length ? crowd : little));
      while (const auto telegram = framer.next()) {
        REQUIRE(telegram->payload == good);
        ++count;
      }
      REQUIRE(count == (length ? crowd.size() / little.size() : 1));
    }
  }
}

TEST_CASE("what never ends is given up, and memory stays bounded") {
  for (const Dialect dialect : {Dialect::ascii, Dialect::binary}) {
    Framer framer(dialect);
    std::string block;
    while (block.size() < 65535) block += "stu";  // whose checksum is not its next byte
    framer.feed(dialect == Dialect::ascii ? std::string("\x02") : bytes("02020202 0003FFFF"));
    for (int i = 0; i < 40; ++i) {
      framer.feed(block);
      while (framer.next()) FAIL("a telegram out of nothing");
      REQUIRE(framer.pending() <= kLongestTelegram + 16);
    }
    CHECK(payloads(framer, framed(dialect, "sAN Run 1")) == std::vector<std::string>{"sAN Run 1"});
  }
  Framer framer;
  CHECK(payloads(framer, bytes("02020202 FFFFFFFF 73") + framed(Dialect::binary, "sFA12")).size() ==
        1);
  CHECK(framer.counts().bad_lengths > 0);
}
