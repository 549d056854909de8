// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <filesystem>
#include <thread>

#include "test_sweep.hpp"

using velum::lms511::Dialect;
using velum::lms511::ErrorCode;
using velum::lms511::Scan;
using velum::lms511::Writer;
namespace fs = std::filesystem;
using namespace lms;  // NOLINT

TEST_CASE("a sweep over TCP becomes the room, in both dialects") {
  for (const Dialect dialect : {Dialect::ascii, Dialect::binary}) {
    Peer peer;
    peer.dialect = dialect;
    peer.start();
    Stage stage = scanner(peer, 60);
    stage.set("encoding", dialect == Dialect::ascii ? "cola_a" : "cola_b");
    const Outcome outcome = stage.run();
    CHECK(outcome.cloud().size() == 60 * 191);
    CHECK(worst(outcome.cloud(), peer.scan.room) < kMillimetre);
    CHECK(outcome.measure("lost_lines") == 0);
    CHECK(outcome.measure("connections") == 1);
    CHECK(outcome.warnings.empty());
  }
}

TEST_CASE("the dialect is found out where it is not given") {
  Peer peer;
  peer.dialect = Dialect::ascii;
  peer.start();
  const Outcome outcome =
      scanner(peer, 5).set("encoding", "auto").set("answer_timeout", "0.3 s").run();
  CHECK(outcome.measure("lines") == 5);
}

TEST_CASE("live scan, recording and replay give the same bytes") {
  const fs::path path =
      fs::temp_directory_path() / ("velum_live_" + std::to_string(::getpid()) + ".vrec");
  Peer peer;
  peer.sends = [](const Peer::Client& client, int line, const std::string& frame) {
    return line == 20 ? client.send(frame) && false : client.send(frame);  // closes once
  };
  peer.start();
  const Outcome live = scanner(peer, 40).set("record", path.string()).run();
  CHECK(live.measure("connections") == 2);
  const Outcome again = Stage("devices.replay")
                            .set("file", path.string())
                            .set("tilt", "constant")
                            .set("tilt_start", "-0.5 rad")
                            .set("tilt_speed", "0.25 rad")
                            .run();
  CHECK(hash_of(velum::Value(live.cloud())) == hash_of(velum::Value(again.cloud())));
  CHECK(live.cloud().size() == 40 * 191);
  fs::remove(path);
}

TEST_CASE("two scanners begin together on a local trigger, and the skew is measured") {
  Peer peers[2];                       // NOLINT
  std::optional<Outcome> outcomes[2];  // NOLINT
  std::thread threads[2];              // NOLINT
  for (int i = 0; i < 2; ++i) {
    peers[i].pause_ms = 5 + i;
    peers[i].start();
    threads[i] = std::thread([&, i] {
      outcomes[i] =
          scanner(peers[i], 10).set("trigger", "local:pair").set("trigger_count", 2).run();
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& outcome : outcomes) {
    REQUIRE(outcome);
    CHECK(outcome->measure("skew") >= 0.0);
    CHECK(outcome->cloud().size() > 0);
  }
}

TEST_CASE("a sweep begins with a message on a port") {
  Peer peer;
  peer.start();
  std::atomic<bool> over{false};
  std::thread caller([&] {  // calls until it is heard
    const int descriptor = ::socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(45811);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    while (!over) {
      ::sendto(descriptor, "go", 2, 0, reinterpret_cast<sockaddr*>(&place),
               sizeof(place));  // NOLINT
      ::usleep(20000);
    }
    ::close(descriptor);
  });
  const Outcome outcome = scanner(peer, 10).set("trigger", "udp:45811").run();
  over = true;
  caller.join();
  CHECK(outcome.measures.count("skew") == 1);
  Peer waits;
  waits.start();
  const Error error =
      failure(scanner(waits, 5).set("trigger", "tcp:45812").set("trigger_timeout", "0.3 s"));
  CHECK(says(error, "no trigger from tcp:45812 within 0.3 s"));
}

TEST_CASE("pairs that the device does not do are refused before anything is connected") {
  const auto refused = [](const char* frequency, const char* resolution) {
    return failure(Stage("devices.lms511")
                       .set("lines", 5)
                       .set("frequency", frequency)
                       .set("resolution", resolution));
  };
  const Error error = refused("50", "0.25");
  CHECK(error.fault() == Fault::graph);
  CHECK(says(error, "does not do 50 Hz with 0.25 degrees"));
  CHECK(says(error, "100 Hz 0.6667"));
  CHECK(failure(Stage("devices.lms511").set("lines", 5).set("frequency", 25)).fault() ==
        Fault::graph);
  CHECK(says(failure(Stage("devices.lms511")), "nothing ends the sweep"));
  CHECK(failure(Stage("devices.lms511").set("lines", 5).set("view_to", 190)).fault() ==
        Fault::graph);
  CHECK(failure(Stage("devices.lms511").set("lines", 5).set("trigger", "bell")).fault() ==
        Fault::graph);
  CHECK(failure(Stage("devices.lms511").set("lines", 5).set("address", "a:b")).fault() ==
        Fault::graph);
}

TEST_CASE("an interrupted scan ends at once") {
  Peer peer;
  peer.start();
  CHECK_THROWS_AS(scanner(peer, 5).cancelled().run(), velum::Cancelled);
}

TEST_CASE("devices.lms511 keeps the promises of every stage") {
  Peer peer;
  peer.start();
  for (const auto& fault : velum::test::conformance(
           "devices.lms511", {{"address", peer.address()}, {"encoding", "cola_b"}, {"lines", "2"}}))
    FAIL_CHECK(fault);
}
