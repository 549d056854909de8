// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <velum/testing.hpp>

#include "lms511/import.hpp"
#include "lms511/test_peer.hpp"
#include "lms511/view.hpp"

using lms::Peer;
using velum::Error;
using velum::Fault;
using velum::test::Outcome;
using velum::test::Stage;
namespace fs = std::filesystem;
namespace device = velum::lms511;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("velum_recorder_" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  [[nodiscard]] std::string file(const std::string& name) const { return (path / name).string(); }
};

Stage recorder(const std::string& address, const std::string& file) {
  Stage stage("devices.recorder");
  stage.set("address", address).set("file", file).set("encoding", "cola_b");
  stage.set("silence_timeout", "5 s").set("give_up", "20 s");
  return stage;
}

double lines_in(const std::string& file) {
  lms::QuietContext context;
  device::LineGatherer lines;
  static_cast<void>(device::read_records(
      file, [&](const device::Record& record) { lines.add(record); }, context));
  return static_cast<double>(lines.counts().lines);
}

}  // namespace

TEST_CASE("a recording holds what the device sent, and what it said of itself") {
  const Folder folder;
  Peer peer;
  peer.start();
  const Outcome outcome = recorder(peer.address(), folder.file("a.vrec")).set("lines", 50).run();
  CHECK(outcome.measure("lines") == 50);
  CHECK(outcome.measure("lost_lines") == 0);
  CHECK(outcome.get<velum::Table>().size() == 8);
  CHECK(lines_in(folder.file("a.vrec")) == 50);
  std::string facts;
  lms::QuietContext context;
  const auto counts = device::read_records(
      folder.file("a.vrec"),
      [&](const device::Record& record) {
        if (record.event == device::Event::identity || record.event == device::Event::configuration)
          facts += std::string(record.bytes) + "; ";
      },
      context);
  CHECK(counts.ended);
  CHECK(facts.find("model = LMS511-10100; firmware = V1.80") != std::string::npos);
  CHECK(facts.find("scan_frequency = 2500") != std::string::npos);
}

TEST_CASE("a long recording is cut into parts") {
  const Folder folder;
  Peer peer;
  peer.start();
  Stage stage = recorder(peer.address(), folder.file("a.vrec"));
  const Outcome outcome = stage.set("lines", 900).set("rotate", 0.005).run();
  CHECK(outcome.measure("parts") >= 2);
  CHECK(fs::exists(folder.file("a.0001.vrec")));
  CHECK(lines_in(folder.file("a.vrec")) == 900);
}

TEST_CASE("a recorder killed at any moment leaves a recording that replays up to then") {
  const Folder folder;
  Peer peer;
  peer.start();
  const std::string address = peer.address();
  velum::Random random(5);
  int with_lines = 0;
  for (int kill = 0; kill < 20; ++kill) {
    const std::string file = folder.file(std::to_string(kill) + ".vrec");
    const pid_t child = ::fork();
    if (child == 0) {
      try {
        static_cast<void>(recorder(address, file).set("lines", 1000000).run());
      } catch (...) {
      }
      ::_exit(0);
    }
    ::usleep(static_cast<useconds_t>(random.uniform(100e3, 500e3)));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    REQUIRE(WIFSIGNALED(status));
    if (!fs::exists(file) || fs::file_size(file) <= 16) continue;  // before the first block
    const Outcome replayed = Stage("devices.replay").set("file", file).run();
    CHECK(replayed.measure("lost_lines") == 0);
    CHECK(replayed.measure("malformed") == 0);
    if (replayed.measure("lines") > 0) ++with_lines;
  }
  CHECK(with_lines >= 5);
}

TEST_CASE("a device that is given up leaves what it sent") {
  const Folder folder;
  Peer peer;
  peer.greets = [](const Peer::Client& client) { return client.number == 0; };
  peer.sends = [](const Peer::Client& client, int line, const std::string& frame) {
    return client.send(frame) && line < 9;
  };
  peer.start();
  try {
    static_cast<void>(recorder(peer.address(), folder.file("a.vrec")).set("give_up", "2 s").run());
    FAIL("recorded a scanner that is gone");
  } catch (const Error& error) {
    CHECK(error.fault() == Fault::device);
    CHECK(error.hint().find("10 lines are in") != std::string::npos);
  }
  CHECK(lines_in(folder.file("a.vrec")) == 10);
}

TEST_CASE("a file that cannot be written is said before anything is connected") {
  Peer peer;
  peer.start();
  try {
    static_cast<void>(recorder(peer.address(), "/nonexistent/a.vrec").set("lines", 5).run());
    FAIL("recorded into nothing");
  } catch (const Error& error) {
    CHECK(error.fault() == Fault::output);
    CHECK(error.where() == "/nonexistent/a.vrec");
  }
  CHECK(peer.connections() == 0);
}

TEST_CASE("angles that arrive are recorded and make the tilt") {
  const Folder folder;
  Peer peer;
  peer.pause_ms = 10;
  peer.start();
  std::atomic<bool> over{false};
  std::thread plate([&] {
    const int descriptor = ::socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(45813);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    for (double angle = 0.0; !over; angle += 0.1) {
      const std::string text = std::to_string(angle);
      ::sendto(descriptor, text.data(), text.size(), 0, reinterpret_cast<sockaddr*>(&place),
               sizeof(place));  // NOLINT
      ::usleep(10000);
    }
    ::close(descriptor);
  });
  const Outcome outcome = recorder(peer.address(), folder.file("a.vrec"))
                              .set("feed", "udp:45813")
                              .set("lines", 40)
                              .run();
  over = true;
  plate.join();
  CHECK(outcome.measure("lines") == 40);
  const Outcome replayed =
      Stage("devices.replay").set("file", folder.file("a.vrec")).set("tilt", "feed").run();
  CHECK(replayed.cloud().size() > 0);
  CHECK(replayed.cloud().column("tilt").vector<float>().maxCoeff() > 0.001F);
}

TEST_CASE("the live view shows rates, ranges and the last line from the side") {
  lms::RoomScan scan;
  device::LineGatherer lines;
  scan.play([&](const device::Record& record) { lines.add(record); });
  device::LiveView view;
  CHECK(view.draw({}, 0.5, 0.0, 0).find("no line yet") != std::string::npos);
  view.see(lines.lines().back());
  const std::string picture = view.draw(lines.counts(), 4.5, 0.5, 2'000'000);
  CHECK(picture.starts_with(device::kViewMark));
  CHECK(picture.find("101 lines  25.2 lines/s  0 lost") != std::string::npos);
  CHECK(picture.find("2.0 MB  50 %") != std::string::npos);
  CHECK(std::count(picture.begin(), picture.end(), '\n') == 16);
  CHECK(std::count(picture.begin(), picture.end(), '#') > 30);
}

TEST_CASE("devices.recorder keeps the promises of every stage") {
  const Folder folder;
  Peer peer;
  peer.start();
  for (const auto& fault :
       velum::test::conformance("devices.recorder", {{"address", peer.address()},
                                                     {"encoding", "cola_b"},
                                                     {"lines", "2"},
                                                     {"file", folder.file("a.vrec")}}))
    FAIL_CHECK(fault);
}
