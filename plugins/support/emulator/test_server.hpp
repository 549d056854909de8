// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <array>
#include <catch2/catch.hpp>
#include <optional>
#include <string>
#include <thread>

#include "emulator/server.hpp"
#include "run/local_context.hpp"

/// For tests of the server: one that runs, and a client that calls it.
namespace emulated {

using namespace velum;
using namespace velum::emulator;
using lms511::Dialect;
using lms511::Scan;

inline constexpr lms511::Mode kQuick{10000, 10000, 1};

inline scene::Scene wall() {
  return scene::parse_scene(
      "format = 1\nunits = \"m\"\n[object.wall]\nshape = \"plane\"\nlabel = 1\n"
      "position = [0, 2, 0]\nnormal = [0, -1, 0]\n[scanner.a]\nnoise = 0.004\n",
      "wall.toml");
}

/// A server in a thread of its own.
class Running {
 public:
  explicit Running(ServerOptions options, const lms511::Mode& mode = kQuick)
      : view_(wall(), "a", Random(1)),
        context_(1, 1),
        server_(ready(options), Device{plain_profile(), mode}, view_, Plate({0, 0, 1}, {}),
                Random(2)),
        thread_([this] {
          try {
            server_.run(context_);
          } catch (const Cancelled&) {
          }
        }) {}
  ~Running() { stop(); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  void stop() {
    context_.cancel();
    if (thread_.joinable()) thread_.join();
  }
  void join() { thread_.join(); }
  [[nodiscard]] const Server& server() const { return server_; }

 private:
  static ServerOptions ready(ServerOptions options) {
    options.port = 0;
    options.settling = 0.05;
    return options;
  }
  View view_;
  run::LocalContext context_;
  Server server_;
  std::thread thread_;
};

inline ServerOptions flat_out(FaultKind fault = FaultKind::none, std::uint64_t after = 5) {
  ServerOptions options;
  options.speed = 0.0;
  options.fault = {fault, after};
  return options;
}

/// A client that waits at most five seconds for what it wants to hear.
class Caller {
 public:
  Caller(std::uint16_t port, Dialect dialect) : dialect_(dialect), framer_(dialect) {
    socket_ = Descriptor(::socket(AF_INET, SOCK_STREAM, 0));
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{.tv_sec = 5, .tv_usec = 0};
    ::setsockopt(socket_.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
    connected_ = ::connect(socket_.get(), reinterpret_cast<sockaddr*>(&to), sizeof(to)) == 0;
  }
  [[nodiscard]] bool connected() const { return connected_; }
  void patience(double seconds) {
    const timeval time{.tv_sec = 0, .tv_usec = static_cast<suseconds_t>(seconds * 1e6)};
    ::setsockopt(socket_.get(), SOL_SOCKET, SO_RCVTIMEO, &time, sizeof(time));
  }
  void say(const lms511::Writer& request) {
    const std::string frame = request.frame();
    REQUIRE(::send(socket_.get(), frame.data(), frame.size(), MSG_NOSIGNAL) ==
            static_cast<ssize_t>(frame.size()));
  }
  void say(const std::string& kind, const std::string& name) {
    say(lms511::Writer(dialect_, kind, name));
  }
  // The payload of the next telegram; nothing when the connection has ended or is silent.
  std::optional<std::string> hear() {
    for (;;) {
      if (const auto telegram = framer_.next()) return std::string(telegram->payload);
      std::array<char, 8192> bytes;
      const auto count = ::recv(socket_.get(), bytes.data(), bytes.size(), 0);
      if (count <= 0) return std::nullopt;
      framer_.feed({bytes.data(), static_cast<std::size_t>(count)});
    }
  }
  // The next telegram that begins so.
  std::optional<std::string> hear(const std::string& head) {
    for (;;) {
      auto payload = hear();
      if (!payload || payload->starts_with(head)) return payload;
    }
  }
  std::optional<Scan> scan() {
    for (;;) {
      const auto payload = hear("sSN LMDscandata");
      if (!payload) return std::nullopt;
      try {
        return lms511::decode_scan({dialect_, *payload});
      } catch (const lms511::Malformed&) {
        ++malformed;
      }
    }
  }
  void subscribe() {
    say(lms511::Writer(dialect_, "sEN", "LMDscandata").u8(1));
    REQUIRE(hear("sEA LMDscandata"));
  }
  void log_in() {
    say(lms511::Writer(dialect_, "sMN", "SetAccessMode").u8(3).u32(0xF4724744));
    REQUIRE(hear("sAN SetAccessMode"));
  }
  [[nodiscard]] const lms511::Framer::Counts& counts() const { return framer_.counts(); }
  int malformed = 0;

 private:
  Dialect dialect_;
  lms511::Framer framer_;
  Descriptor socket_;
  bool connected_ = false;
};

}  // namespace emulated
