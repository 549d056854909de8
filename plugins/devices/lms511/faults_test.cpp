// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Every way in which a scanner may fail, each with its outcome (README.md, "Faults").
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>

#include "test_sweep.hpp"

using velum::lms511::Dialect;
using velum::lms511::ErrorCode;
using velum::lms511::Scan;
using velum::lms511::Writer;
namespace fs = std::filesystem;
using namespace lms;  // NOLINT

TEST_CASE("fault: refused connections are given up after the stated time") {
  Peer peer;  // bound, but it does not listen
  const auto begin = std::chrono::steady_clock::now();
  const Error error = failure(scanner(peer, 5).set("give_up", "0.6 s"));
  CHECK(error.fault() == Fault::device);
  CHECK(says(error, "refused"));
  CHECK(says(error, "given up after 0.6 s"));
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(20));
}

TEST_CASE("fault: a peer that accepts and says nothing is given up") {
  Peer peer;
  peer.greets = [](const Peer::Client& client) {
    while (!client.stopped()) client.pause(10);
    return false;
  };
  peer.start();
  const Error error =
      failure(scanner(peer, 5).set("answer_timeout", "0.2 s").set("give_up", "0.5 s"));
  CHECK(error.fault() == Fault::device);
  CHECK(says(error, "no answer"));
}

TEST_CASE("fault: silence in the middle is a gap, and the sweep goes on") {
  Peer peer;
  peer.sends = [](const Peer::Client& client, int line, const std::string& frame) {
    if (client.number > 0 || line < 10) return client.send(frame);
    client.pause(1500);
    return false;
  };
  peer.start();
  const Outcome outcome = scanner(peer, 20).set("silence_timeout", "0.3 s").run();
  CHECK(outcome.measure("lines") == 20);
  CHECK(outcome.measure("gaps") >= 1);
  CHECK(warned(outcome, "no scan for"));
}

TEST_CASE("fault: telegrams in pieces, and many in one piece, lose nothing") {
  Peer pieces;
  pieces.sends = [](const Peer::Client& client, int line, const std::string& frame) {
    const std::size_t cut = static_cast<std::size_t>(line) * 37 % frame.size();
    if (!client.send(std::string_view(frame).substr(0, cut))) return false;
    client.pause(1);
    return client.send(std::string_view(frame).substr(cut));
  };
  pieces.start();
  const Outcome cut = scanner(pieces, 30).run();
  CHECK(cut.measure("lost_lines") == 0);
  CHECK(worst(cut.cloud(), pieces.scan.room) < kMillimetre);
  Peer heaps;
  std::string heap;
  heaps.sends = [&](const Peer::Client& client, int line, const std::string& frame) {
    heap += frame;
    if (line % 10 != 9) return true;
    return client.send(std::exchange(heap, ""));
  };
  heaps.start();
  const Outcome heaped = scanner(heaps, 30).run();
  CHECK(heaped.measure("lost_lines") == 0);
  CHECK(heaped.measure("lines") == 30);
}

TEST_CASE("fault: a wrong checksum or length, or garbage, costs no more than its telegram") {
  Peer peer;
  peer.sends = [](const Peer::Client& client, int line, const std::string& frame) {
    std::string sent = frame;
    if (line == 5) sent[40] = static_cast<char>(sent[40] ^ 1);
    if (line == 10) sent[6] = static_cast<char>(sent[6] ^ 1);
    if (line == 15) sent = std::string("\x02\x02garbage\x03\x02\x02\x02\x02", 14) + sent;
    return client.send(sent);
  };
  peer.start();
  const Outcome outcome = scanner(peer, 40).run();
  CHECK(outcome.measure("lines") == 40);
  CHECK(outcome.measure("lost_lines") == 2);
  CHECK(outcome.measure("bad_checksums") >= 1);
  CHECK(outcome.measure("garbage") > 14);
  CHECK(outcome.measure("connections") == 1);
  CHECK(warned(outcome, "2 revolutions are missing"));
  CHECK(worst(outcome.cloud(), peer.scan.room) < kMillimetre);
}

TEST_CASE("fault: a flood is taken up to the end of the sweep") {
  Peer peer;
  peer.pause_ms = 0;
  peer.start();
  const Outcome outcome = scanner(peer, 400).run();
  CHECK(outcome.measure("lines") == 400);
  CHECK(outcome.measure("lost_lines") == 0);
}

TEST_CASE("fault: a flood without telegrams is no scanner") {
  Peer peer;
  peer.greets = [](const Peer::Client& client) {
    const std::string block(65536, 'x');
    while (client.send(block)) {
    }
    return false;
  };
  peer.start();
  const Error error =
      failure(scanner(peer, 5).set("answer_timeout", "0.3 s").set("give_up", "0.5 s"));
  CHECK(error.fault() == Fault::device);
}

TEST_CASE("fault: a slow drip of bytes is silence") {
  Peer peer;
  peer.sends = [](const Peer::Client& client, int line, const std::string& frame) {
    if (line < 5) return client.send(frame);
    for (const char c : frame) {
      if (!client.send({&c, 1})) return false;
      client.pause(20);
    }
    return true;
  };
  peer.start();
  const Error error =
      failure(scanner(peer, 50).set("give_up", "1 s").set("silence_timeout", "2 s"));
  CHECK(error.fault() == Fault::device);
  CHECK(says(error, "no scan for"));
  CHECK(says(error, "lines were scanned before"));
}

TEST_CASE("fault: a reset in the middle is a gap, and half a telegram is not mixed with the next") {
  Peer peer;
  peer.sends = [](const Peer::Client& client, int line, const std::string& frame) {
    if (client.number > 0 || line < 10) return client.send(frame);
    client.send(std::string_view(frame).substr(0, frame.size() / 2));
    client.pause(50);
    client.reset();
    return false;
  };
  peer.start();
  const Outcome outcome = scanner(peer, 20).set("silence_timeout", "2 s").run();
  CHECK(outcome.measure("lines") == 20);
  CHECK(outcome.measure("gaps") == 1);
  CHECK(outcome.measure("connections") == 2);
  CHECK(outcome.measure("malformed") == 0);
  CHECK(outcome.measure("bad_checksums") == 0);
}

TEST_CASE("fault: a power cycle in the middle of a sweep begins a new clock and new counters") {
  Peer peer;
  peer.sends = [](const Peer::Client& client, int line, const std::string& frame) {
    return client.send(frame) && (client.number > 0 || line < 10);
  };
  peer.scans = [&](const Peer::Client& client, int line) {
    Scan scan = peer.scan.line(line);
    if (client.number > 0) scan.start_time = 5000000U + 40000U * static_cast<std::uint32_t>(line);
    scan.send_time = scan.start_time + 40500;
    if (client.number > 0 && line == 0) scan.status = {1, 0};
    return scan;
  };
  int asked = 0;
  peer.answers["sRN STlms"] = [&](Dialect dialect) {  // boots, then measures
    const int state = ++asked == 2 || asked == 3 ? 1 : 7;
    return Writer(dialect, "sRA", "STlms").u16(static_cast<std::uint16_t>(state)).frame();
  };
  peer.start();
  const Outcome outcome = scanner(peer, 20).run();
  CHECK(outcome.measure("lines") == 20);
  CHECK(outcome.measure("connections") == 2);
  CHECK(outcome.measure("lost_lines") == 0);
  const auto time = outcome.cloud().column("time").vector<double>();
  for (Index i = 1; i < time.size(); ++i) REQUIRE(time[i] >= time[i - 1]);
}

TEST_CASE("fault: a device that has its client already lets us in when that one leaves") {
  Peer peer;
  peer.greets = [](const Peer::Client& client) { return client.number >= 3; };
  peer.start();
  const Outcome outcome = scanner(peer, 5).run();
  CHECK(outcome.measure("lines") == 5);
  CHECK(warned(outcome, "connecting again"));
}

TEST_CASE("fault: each error answer is named, and the scan goes on where it can") {
  for (unsigned code = 1; code <= 0x1A; ++code) {
    Peer peer;
    peer.answers["sWN LMDscandatacfg"] = Peer::refusal(static_cast<ErrorCode>(code));
    peer.start();
    const Outcome outcome = scanner(peer, 2).run();
    CHECK(outcome.measure("lines") == 2);
    CHECK(warned(outcome, "LMDscandatacfg: " + in_words(static_cast<ErrorCode>(code))));
  }
  Peer mute;
  mute.answers["sEN LMDscandata"] = Peer::refusal(ErrorCode::busy);
  mute.start();
  const Error error = failure(scanner(mute, 2).set("give_up", "0.5 s"));
  CHECK(error.fault() == Fault::device);
  CHECK(says(error, "sFA D (the device is busy)"));
}

TEST_CASE("fault: a refused login is said, and the scan goes on") {
  Peer peer;
  peer.answers["sMN SetAccessMode"] =
      Peer::frame_of([](Dialect d) { return Writer(d, "sAN", "SetAccessMode").u8(0); });
  peer.start();
  const Outcome outcome = scanner(peer, 5).run();
  CHECK(outcome.measure("lines") == 5);
  CHECK(warned(outcome, "login was refused"));
}

TEST_CASE("fault: another model or firmware is refused at once, unless any will do") {
  Peer peer;
  peer.answers["sRN DeviceIdent"] = Peer::frame_of(
      [](Dialect d) { return Writer(d, "sRA", "DeviceIdent").text16("LMS10x").text16("V1.36"); });
  peer.start();
  const Error error = failure(scanner(peer, 5));
  CHECK(error.fault() == Fault::device);
  CHECK(says(error, "the model 'LMS10x' is not supported"));
  CHECK(peer.connections() == 1);
  CHECK(scanner(peer, 5).set("any_model", "true").run().measure("lines") == 5);
  Peer old;
  old.answers["sRN FirmwareVersion"] =
      Peer::frame_of([](Dialect d) { return Writer(d, "sRA", "FirmwareVersion").text16("X0.1"); });
  old.start();
  CHECK(says(failure(scanner(old, 5)), "the firmware 'X0.1' is not supported"));
}

TEST_CASE("fault: a device in error is said at once") {
  Peer peer;
  peer.answers["sRN STlms"] =
      Peer::frame_of([](Dialect d) { return Writer(d, "sRA", "STlms").u16(10); });
  peer.start();
  CHECK(says(failure(scanner(peer, 5)), "in error"));
}

TEST_CASE("what was scanned before a failure is kept") {
  const fs::path path =
      fs::temp_directory_path() / ("velum_kept_" + std::to_string(::getpid()) + ".vrec");
  Peer peer;
  peer.greets = [](const Peer::Client& client) { return client.number == 0; };
  peer.sends = [](const Peer::Client& client, int line, const std::string& frame) {
    return client.send(frame) && line < 14;
  };
  peer.start();
  const Error error = failure(scanner(peer, 50).set("give_up", "2 s").set("record", path.string()));
  CHECK(error.fault() == Fault::device);
  CHECK(says(error, "15 lines that were scanned before are in " + path.string()));
  CHECK(Stage("devices.replay").set("file", path.string()).run().measure("lines") == 15);
  fs::remove(path);
}
