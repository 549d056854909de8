// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "emulator/test_server.hpp"

using namespace emulated;

namespace {

struct Heard {
  int scans = 0;
  int gaps = 0;
};
Heard listen_for(Caller& caller, int scans) {
  Heard heard;
  std::optional<std::uint16_t> last;
  while (heard.scans < scans) {
    const auto scan = caller.scan();
    if (!scan) return heard;
    if (last && static_cast<std::uint16_t>(*last + 1) != scan->scan_counter) ++heard.gaps;
    last = scan->scan_counter;
    ++heard.scans;
  }
  return heard;
}

}  // namespace

TEST_CASE("several clients get every scan, each in its dialect") {
  const Running running(flat_out());
  Caller ascii(running.server().ascii_port(), Dialect::ascii);
  Caller binary(running.server().host_port(), Dialect::binary);
  ascii.subscribe();
  binary.subscribe();
  const auto first = binary.scan();
  REQUIRE(first);
  std::optional<Scan> same;
  while (!same || same->scan_counter < first->scan_counter) same = ascii.scan();
  REQUIRE(same);
  CHECK(same->scan_counter == first->scan_counter);
  CHECK(same->channel("DIST1")->values == first->channel("DIST1")->values);
  CHECK(listen_for(ascii, 300).gaps == 0);
  CHECK(listen_for(binary, 300).gaps == 0);
}

TEST_CASE("answers come between scans and events") {
  const Running running(flat_out());
  Caller caller(running.server().host_port(), Dialect::binary);
  caller.say(lms511::Writer(Dialect::binary, "sEN", "LIDoutputstate").u8(1));
  CHECK(caller.hear("sEA LIDoutputstate"));
  CHECK(caller.hear("sSN LIDoutputstate").value_or("").size() == 108);
  caller.subscribe();
  caller.say("sRN", "FirmwareVersion");
  CHECK(caller.hear("sRA FirmwareVersion"));
  CHECK(caller.scan());
  caller.say("sRN", "LMDscandata");
  const auto polled = caller.hear("sRA LMDscandata");
  REQUIRE(polled);
  CHECK(lms511::decode_scan({Dialect::binary, *polled}).polled);
}

TEST_CASE("the first scan after a start was made with the laser off") {
  const Running running(flat_out());
  Caller caller(running.server().host_port(), Dialect::binary);
  caller.log_in();
  caller.say("sMN", "LMCstartmeas");
  REQUIRE(caller.hear("sAN LMCstartmeas"));
  caller.subscribe();
  CHECK(caller.scan().value().status == std::array<std::uint8_t, 2>{1, 0});
  CHECK(caller.scan().value().status == std::array<std::uint8_t, 2>{0, 0});
}

TEST_CASE("at real time scans come at the rate of the mirror, the first after a moment") {
  ServerOptions options;
  const Running running(options);
  Caller caller(running.server().host_port(), Dialect::binary);
  caller.subscribe();
  const auto begin = std::chrono::steady_clock::now();
  REQUIRE(listen_for(caller, 30).gaps == 0);
  const double took =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  CHECK(took > 0.2 + 0.25);  // it cannot be faster; how late it is depends on the machine
}

TEST_CASE("EIHstCola holds for the next connection of the host port") {
  const Running running(flat_out());
  Caller binary(running.server().host_port(), Dialect::binary);
  binary.log_in();
  binary.say(lms511::Writer(Dialect::binary, "sWN", "EIHstCola").u8(0));
  REQUIRE(binary.hear("sWA EIHstCola"));
  binary.say("sRN", "SCdevicestate");
  CHECK(binary.hear("sRA SCdevicestate"));
  Caller ascii(running.server().host_port(), Dialect::ascii);
  ascii.say("sRN", "SCdevicestate");
  CHECK(ascii.hear("sRA SCdevicestate") == "sRA SCdevicestate 1");
}

TEST_CASE("another speed of the mirror takes a while, then scans have it") {
  const Running running(flat_out());
  Caller caller(running.server().host_port(), Dialect::binary);
  caller.log_in();
  caller.say(lms511::Writer(Dialect::binary, "sMN", "mLMPsetscancfg")
                 .u32(2500)
                 .i16(1)
                 .u32(1667)
                 .i32(-50000)
                 .i32(1850000));
  REQUIRE(caller.hear("sAN mLMPsetscancfg"));
  caller.say("sMN", "Run");
  REQUIRE(caller.hear("sAN Run"));
  caller.subscribe();
  const auto scan = caller.scan();
  REQUIRE(scan);
  CHECK(scan->scan_frequency == 2500);
  CHECK(scan->channel("DIST1")->values.size() == 1141);
}

TEST_CASE("a client that does not read loses scans, and others none") {
  ServerOptions options;
  options.speed = 100.0;
  Running running(options);
  Caller lazy(running.server().host_port(), Dialect::binary);
  Caller eager(running.server().host_port(), Dialect::binary);
  lazy.subscribe();
  eager.subscribe();
  // Far more than the socket and the server keep for the lazy one.
  CHECK(listen_for(eager, 12000).gaps == 0);
  running.stop();
  CHECK(running.server().counts().dropped > 0);
}

TEST_CASE("it ends when its clients have left") {
  ServerOptions options = flat_out();
  options.sessions = 1;
  Running running(options);
  {
    Caller caller(running.server().host_port(), Dialect::binary);
    caller.subscribe();
    CHECK(listen_for(caller, 3).scans == 3);
  }
  running.join();
  CHECK(running.server().counts().connections == 1);
}

TEST_CASE("a port that is taken is a fault of the device") {
  const Running running(flat_out());
  try {
    const Listener second("127.0.0.1", running.server().host_port());
    FAIL("listens twice on one port");
  } catch (const Error& error) {
    CHECK(error.fault() == velum::Fault::device);
  }
}

TEST_CASE("spoiled telegrams: what a client can and cannot find") {
  for (const Dialect dialect : {Dialect::ascii, Dialect::binary}) {
    const auto run = [&](FaultKind kind, int scans, auto&& check) {
      const Running running(flat_out(kind));
      Caller caller(
          dialect == Dialect::ascii ? running.server().ascii_port() : running.server().host_port(),
          dialect);
      caller.subscribe();
      const Heard result = listen_for(caller, scans);
      INFO("fault " << static_cast<int>(kind) << ", dialect " << lms511::name_of(dialect));
      check(result, caller);
    };
    const auto whole = [](int scans) {
      return [scans](const Heard& result, Caller&) {
        CHECK(result.scans == scans);
        CHECK(result.gaps == 0);
      };
    };
    run(FaultKind::split, 60, whole(60));
    run(FaultKind::drip, 8, whole(8));
    run(FaultKind::flood, 40, whole(40));
    run(FaultKind::gap, 100, [](const Heard& result, Caller&) { CHECK(result.gaps >= 9); });
    if (dialect == Dialect::binary) {
      run(FaultKind::garbage, 60, whole(60));
      run(FaultKind::checksum, 100, [](const Heard& result, Caller& caller) {
        CHECK(result.gaps >= 9);
        CHECK(caller.counts().bad_checksums >= 9);
      });
      run(FaultKind::length, 100, [](const Heard& result, Caller& caller) {
        CHECK(result.scans == 100);
        CHECK(caller.counts().skipped_bytes > 0);
      });
    }
  }
}

TEST_CASE("connections that end, and how") {
  const Running half(flat_out(FaultKind::half));
  Caller first(half.server().host_port(), Dialect::binary);
  first.subscribe();
  CHECK(listen_for(first, 100).scans == 5);
  Caller again(half.server().host_port(), Dialect::binary);
  again.subscribe();
  CHECK(listen_for(again, 100).scans == 100);  // it strikes once

  const Running reset(flat_out(FaultKind::reset));
  Caller second(reset.server().host_port(), Dialect::binary);
  // A reset also takes what has arrived and was not read yet.
  second.say(lms511::Writer(Dialect::binary, "sEN", "LMDscandata").u8(1));
  CHECK(listen_for(second, 100).scans <= 5);

  const Running silent(flat_out(FaultKind::silence));
  Caller third(silent.server().host_port(), Dialect::binary);
  third.subscribe();
  third.patience(0.3);
  CHECK(listen_for(third, 100).scans == 5);
  third.say("sRN", "SCdevicestate");
  CHECK_FALSE(third.hear());

  const Running busy(flat_out(FaultKind::busy));
  Caller owner(busy.server().host_port(), Dialect::binary);
  owner.subscribe();
  Caller guest(busy.server().host_port(), Dialect::binary);
  CHECK_FALSE(guest.hear());
  CHECK(owner.scan());
}

TEST_CASE("after a power cycle the device comes back with its clock at 0") {
  ServerOptions options;
  options.speed = 20.0;
  options.fault = {FaultKind::power_cycle, 50};
  const Running running(options);
  Caller before(running.server().host_port(), Dialect::binary);
  before.subscribe();
  std::uint32_t last = 0;
  while (const auto scan = before.scan()) last = scan->start_time;
  CHECK(last > 400'000);
  std::optional<Caller> after;
  for (int i = 0; i < 100 && (!after || !after->connected()); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    after.emplace(running.server().host_port(), Dialect::binary);
  }
  REQUIRE(after->connected());
  after->subscribe();
  const auto scan = after->scan();
  REQUIRE(scan);
  CHECK(scan->telegram_counter == 0);
}
