// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <fstream>
#include <velum/testing.hpp>

using velum::test::Stage;

namespace {

const std::string kBoards =
    std::string(VELUM_SOURCE_DIR) + "/graphs/characterisation/scenes/boards.toml";
const std::string kTunnel = std::string(VELUM_SOURCE_DIR) + "/graphs/scenes/wind_tunnel.toml";

Stage emulator(const std::string& scanner = "gennaker") {
  return Stage("devices.emulator")
      .set("scene", kTunnel)
      .set("scanner", scanner)
      .set("port", "0")
      .set("lifetime", "0.1 s");
}
std::string hint_of(Stage stage) {
  try {
    static_cast<void>(stage.run());
  } catch (const velum::Error& error) {
    return error.hint();
  }
  return "it ran";
}

}  // namespace

TEST_CASE("an emulator without clients serves its time and says what it did") {
  const auto outcome = emulator().run();
  CHECK(outcome.results.empty());
  CHECK(outcome.measure("connections") == 0.0);
  CHECK(outcome.measure("scans") == 0.0);
}

TEST_CASE("only pairs that an LMS 511 has are taken") {
  CHECK(hint_of(emulator().set("frequency", "60")).find("25 Hz at 0.1667") != std::string::npos);
  CHECK(hint_of(emulator().set("frequency", "100").set("resolution", "0.25 deg")) != "it ran");
  CHECK(hint_of(emulator().set("frequency", "100").set("resolution", "0.1667 deg")) == "it ran");
  CHECK(hint_of(emulator().set("resolution", "0.16666 deg")) == "it ran");
}

TEST_CASE("a scene with several scanners wants one named") {
  CHECK(hint_of(emulator("")) == "known: gennaker, mainsail");
  CHECK(hint_of(emulator("bow")) == "known: gennaker, mainsail");
}

TEST_CASE("effects are checked before anything runs") {
  CHECK_THROWS_AS(emulator().set("errors", "rain").run(), velum::Error);
  CHECK(hint_of(emulator().set("errors", "all")) == "it ran");
}

TEST_CASE("an address that is not this machine's is a fault of the device") {
  try {
    static_cast<void>(emulator().set("address", "192.0.2.1").run());
    FAIL("listens on an address of nobody");
  } catch (const velum::Error& error) {
    CHECK(error.fault() == velum::Fault::device);
  }
}

TEST_CASE("it stops when it is interrupted") {
  Stage stage = emulator();
  stage.set("lifetime", "0 s").cancelled();
  CHECK_THROWS_AS(stage.run(), velum::Cancelled);
}

TEST_CASE("every fault has a name") {
  for (const char* fault :
       {"none", "refuse", "model", "error", "busy", "silence", "split", "drip", "half", "length",
        "checksum", "garbage", "flood", "gap", "reset", "power_cycle"})
    CHECK_NOTHROW(emulator().set("fault", fault));
  CHECK_THROWS_AS(emulator().set("fault", "sulking"), velum::Error);
}

TEST_CASE("devices.emulator keeps the promises of every stage") {
  for (const auto& fault : velum::test::conformance("devices.emulator", {{"scene", kBoards},
                                                                         {"scanner", "at_2m"},
                                                                         {"frequency", "50"},
                                                                         {"port", "0"},
                                                                         {"lifetime", "0.05 s"}}))
    FAIL_CHECK(fault);
}
