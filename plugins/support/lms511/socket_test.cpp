// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/socket.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <catch2/catch.hpp>
#include <thread>

#include "lms511/dialogue.hpp"
#include "lms511/listener.hpp"
#include "velum/error.hpp"

using namespace velum::lms511;  // NOLINT

namespace {

const Interrupt kNever = [] {};

// Messages that have arrived within ten seconds, as many as are expected.
std::vector<std::string> heard(const Listener& listener, std::size_t expected) {
  std::vector<std::string> texts;
  std::uint64_t seen = 0;
  for (int i = 0; i < 1000 && texts.size() < expected; ++i) {
    for (const Listener::Message& message : listener.since(seen)) texts.push_back(message.text);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return texts;
}

}  // namespace

TEST_CASE("addresses are IPv4, IPv6 or names, with a port or without") {
  const auto said = [](const char* text) { return in_words(parse_endpoint(text, 2112)); };
  CHECK(said("192.168.0.1") == "192.168.0.1:2112");
  CHECK(said("192.168.0.1:2111") == "192.168.0.1:2111");
  CHECK(said("lms.local:99") == "lms.local:99");
  CHECK(said("::1") == "[::1]:2112");
  CHECK(said("fe80::1:2") == "[fe80::1:2]:2112");
  CHECK(said("[::1]:2111") == "[::1]:2111");
  CHECK(said("[::1]") == "[::1]:2112");
  for (const char* bad : {"", ":2112", "a:", "a:0", "a:70000", "a:x", "[::1", "[]:5"})
    CHECK_THROWS_AS(parse_endpoint(bad, 2112), velum::Error);
}

TEST_CASE("a name that nobody knows and a port where nobody listens are told apart") {
  CHECK_THROWS_WITH(TcpSocket::connect({"no-such-host.invalid", 2112}, 0.5, kNever),
                    Catch::Contains("no-such-host.invalid"));
  CHECK_THROWS_WITH(TcpSocket::connect({"127.0.0.1", 1}, 0.5, kNever), Catch::Contains("refused"));
}

TEST_CASE("waiting can be interrupted") {
  struct Stop {};
  const Handle quiet(::socket(AF_INET, SOCK_DGRAM, 0));
  int calls = 0;
  const Interrupt soon = [&] {
    if (++calls == 3) throw Stop();
  };
  CHECK_THROWS_AS(wait_for(quiet.get(), 1, 60.0, soon), Stop);
}

TEST_CASE("a listener hears the lines of TCP clients, whole or in pieces") {
  const auto listener = Listener::at("tcp:45821");
  CHECK(Listener::at("tcp:45821") == listener);
  TcpSocket one = TcpSocket::connect({"127.0.0.1", 45821}, 5.0, kNever);
  one.send("first\nsec", 5.0, kNever);
  CHECK(heard(*listener, 1) == std::vector<std::string>{"first"});
  one.send("ond\nthird\n", 5.0, kNever);
  CHECK(heard(*listener, 3) == std::vector<std::string>{"first", "second", "third"});
  CHECK(listener->count() == 3);
  CHECK_THROWS_AS(Listener("tcp:45821"), velum::Error);
  for (const char* bad : {"tcp", "tcp:", "tcp:x", "tcp:0", "udp:70000", "icmp:5", ""})
    CHECK_THROWS_AS(Listener::check(bad), velum::Error);
}

TEST_CASE("those that wait together go on together") {
  const Rendezvous first("here", 2);
  CHECK_FALSE(first.begun());
  CHECK(first.present() == 1);
  const Rendezvous elsewhere("there", 2);
  CHECK_FALSE(first.begun());
  {
    const Rendezvous second("here", 2);
    REQUIRE(first.begun());
    CHECK(first.begun() == second.begun());
  }
  const Rendezvous next("here", 2);  // a new round
  CHECK_FALSE(next.begun());
}

TEST_CASE("settings that a device does not have are refused at their parameter") {
  const auto place = [](const DeviceSettings& settings) {
    try {
      settings.check();
    } catch (const velum::Error& error) {
      CHECK(error.fault() == velum::Fault::graph);
      return error.where();
    }
    return std::string("fine");
  };
  constexpr double kDegree = 0.017453292519943295;
  for (const Mode& mode : kModes) {
    DeviceSettings settings;
    settings.frequency = 0.01 * mode.frequency;
    settings.resolution = 1e-4 * mode.resolution * kDegree;
    CHECK(place(settings) == "fine");
  }
  DeviceSettings settings;
  settings.frequency = 35.0;
  CHECK(place(settings) == "resolution");
  settings.resolution = 0.3333 * kDegree;
  CHECK(place(settings) == "frequency");
  settings = {};
  settings.view_from = -6.0 * kDegree;
  CHECK(place(settings) == "view_from");
  settings.view_from = 90.0 * kDegree;
  settings.view_to = 80.0 * kDegree;
  CHECK(place(settings) == "view_from");
}
