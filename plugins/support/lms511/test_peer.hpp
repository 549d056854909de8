// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <thread>

#include "lms511/test_room.hpp"

/// A scripted scanner on loopback for the tests of the driver: answers the start dialogue, streams
/// the room, and does what a test tells it to do wrong.
namespace lms {

using velum::lms511::Dialect;
using velum::lms511::ErrorCode;
using velum::lms511::Reader;
using velum::lms511::Writer;

class Peer {
 public:
  /// One client.
  struct Client {
    int descriptor = -1;
    int number = 0;  ///< of the connection, from 0
    const Peer* peer = nullptr;

    /// False when the client has gone or the test is over.
    bool send(std::string_view bytes) const {  // NOLINT(modernize-use-nodiscard)
      while (!bytes.empty()) {
        if (peer->stop_) return false;
        pollfd one{descriptor, POLLOUT, 0};
        if (::poll(&one, 1, 20) <= 0) continue;
        const ssize_t sent = ::send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(sent));
      }
      return true;
    }
    /// Closes at once, without a farewell.
    void reset() const {
      const linger now{1, 0};
      ::setsockopt(descriptor, SOL_SOCKET, SO_LINGER, &now, sizeof(now));
    }
    void pause(int milliseconds) const {
      for (int i = 0; i < milliseconds && !peer->stop_; ++i) ::usleep(1000);
    }
    [[nodiscard]] bool stopped() const { return peer->stop_; }
  };

  RoomScan scan;
  Dialect dialect = Dialect::binary;
  int pause_ms = 1;  ///< between scans
  /// Answers to be given instead: by "sRN STlms" a payload, or "" for silence.
  std::map<std::string, std::function<std::string(Dialect)>> answers;
  /// Called for each scan's frame; false ends the connection. Empty: sends it.
  std::function<bool(const Client&, int line, const std::string& frame)> sends;
  /// Called for each connection before anything else; false: that was all.
  std::function<bool(const Client&)> greets;
  /// The scan of a line; empty: the room's.
  std::function<velum::lms511::Scan(const Client&, int line)> scans;

  Peer() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) { bind_to(0); }
  ~Peer() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    ::close(listener_);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  /// Listens from now on.
  void start() {
    ::listen(listener_, 8);
    thread_ = std::thread([this] { serve(); });
  }
  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  [[nodiscard]] int connections() const { return connections_; }

  /// What a device answers with a code instead of a result.
  static std::function<std::string(Dialect)> refusal(ErrorCode code) {
    return [code](Dialect how) { return velum::lms511::error_frame(how, code); };
  }
  static std::function<std::string(Dialect)> frame_of(const std::function<Writer(Dialect)>& make) {
    return [make](Dialect how) { return make(how).frame(); };
  }

 private:
  void bind_to(std::uint16_t port) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(listener_, reinterpret_cast<sockaddr*>(&place), sizeof(place));  // NOLINT
    socklen_t size = sizeof(place);
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&place), &size);  // NOLINT
    port_ = ntohs(place.sin_port);
  }

  void serve() {
    while (!stop_) {
      pollfd one{listener_, POLLIN, 0};
      if (::poll(&one, 1, 5) <= 0) continue;
      Client client{::accept(listener_, nullptr, nullptr), connections_++, this};  // NOLINT
      if (!greets || greets(client)) talk(client);
      ::close(client.descriptor);
    }
  }

  void talk(const Client& client) {
    velum::lms511::Framer framer(dialect);
    std::string buffer(65536, '\0');
    int line = 0;
    bool streaming = false;
    while (!stop_) {
      pollfd one{client.descriptor, POLLIN, 0};
      if (::poll(&one, 1, streaming ? pause_ms : 5) > 0) {
        const ssize_t size = ::recv(client.descriptor, buffer.data(), buffer.size(), 0);
        if (size <= 0) return;
        framer.feed(std::string_view(buffer).substr(0, static_cast<std::size_t>(size)));
        while (const auto telegram = framer.next()) {
          const Reader reader(*telegram);
          const std::string request = std::string(reader.kind()) + " " + std::string(reader.name());
          if (!client.send(answer(request))) return;
          if (request == "sEN LMDscandata") streaming = telegram->payload.back() % 2 != 0;
        }
      }
      if (streaming && !send_line(client, line++)) return;
    }
  }

  bool send_line(const Client& client, int line) {
    const auto sent = scans ? scans(client, line) : this->scan.line(line);
    const std::string frame =
        velum::lms511::framed(dialect, velum::lms511::encode_scan(sent, dialect));
    return sends ? sends(client, line, frame) : client.send(frame);
  }

  std::string answer(const std::string& request) {
    if (const auto at = answers.find(request); at != answers.end()) return at->second(dialect);
    const auto to = [&](const char* kind) {
      return Writer(dialect, kind, std::string_view(request).substr(4));
    };
    if (request == "sMN SetAccessMode" || request == "sMN Run") return to("sAN").u8(1).frame();
    if (request == "sMN mLMPsetscancfg")
      return to("sAN").u8(0).u32(2500).i16(1).u32(1667).i32(-50000).i32(1850000).frame();
    if (request == "sMN LMCstartmeas") return to("sAN").u8(0).frame();
    if (request == "sRN FirmwareVersion") return to("sRA").text16("V1.80    ").frame();
    if (request == "sRN DeviceIdent")
      return to("sRA").text16("LMS511-10100").text16("V1.80").frame();
    if (request == "sRN STlms") return to("sRA").u16(7).u8(0).frame();
    if (request == "sRN LMPscancfg")
      return to("sRA").u32(2500).i16(1).u32(1667).i32(-50000).i32(1850000).frame();
    if (request == "sEN LMDscandata") return to("sEA").u8(1).frame();
    if (request.starts_with("sWN")) return to("sWA").no_parameters().frame();
    return velum::lms511::error_frame(dialect, ErrorCode::variable_unknown);
  }

  int listener_;
  std::uint16_t port_ = 0;
  std::atomic<bool> stop_{false};
  std::atomic<int> connections_{0};
  std::thread thread_;
};

}  // namespace lms
