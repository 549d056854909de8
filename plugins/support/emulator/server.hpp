// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "emulator/client.hpp"
#include "emulator/faults.hpp"
#include "emulator/revolutions.hpp"
#include "velum/context.hpp"

namespace velum::emulator {

struct ServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 2111;  ///< CoLa A; the host port is the next one. 0: any two free ones
  double speed = 1.0;         ///< times real time; 0: as fast as the clients take it
  double lifetime = 0.0;      ///< [s]; 0: until interrupted
  int sessions = 0;           ///< ends when so many clients have left; 0: never
  double settling = 1.0;      ///< silence while the mirror changes its speed [s]
  Fault fault{};
};

/// Brings the device to its clients, on two ports, in one thread. Memory is bounded: a client that
/// does not read loses scans.
class Server {
 public:
  struct Counts {
    std::uint64_t connections = 0;
    std::uint64_t requests = 0;
    std::uint64_t scans = 0;    ///< given to clients
    std::uint64_t dropped = 0;  ///< for want of room
  };
  /// Opens the ports. `view` must outlive the server.
  Server(const ServerOptions& options, const Device& device, const View& view, const Plate& plate,
         const Random& random);

  [[nodiscard]] std::uint16_t ascii_port() const { return ports_[0]; }
  [[nodiscard]] std::uint16_t host_port() const { return ports_[1]; }
  [[nodiscard]] const Counts& counts() const { return counts_; }
  /// Serves until its end; throws Cancelled when the context is.
  void run(Context& context);

 private:
  using Clients = std::vector<std::unique_ptr<Client>>;

  [[nodiscard]] double now() const;
  [[nodiscard]] double clock() const;
  [[nodiscard]] bool flat_out() const { return options_.speed == 0.0; }
  [[nodiscard]] bool quiet() const { return now() < quiet_until_; }
  [[nodiscard]] bool finished() const;
  void listen();
  void wait();
  [[nodiscard]] double patience() const;
  void accept_clients();
  void read_clients();
  void handle(Client& client, const lms511::Telegram& telegram);
  void apply(Effect effect, Client& client, lms511::Dialect dialect);
  void turn();
  [[nodiscard]] bool may_turn() const;
  [[nodiscard]] bool awaited(const Client& client) const;
  void send_scan();
  void give(Client& client, const std::string& frame);
  void write_clients();
  void power_cycle();

  ServerOptions options_;
  Device delivered_;  ///< as after power-up
  Device device_;
  const View& view_;
  Plate plate_;
  Random random_;
  std::array<std::uint16_t, 2> ports_{};
  std::vector<Listener> listeners_;  ///< CoLa A, host port
  Clients clients_;
  std::optional<Revolutions> revolutions_;
  std::chrono::steady_clock::time_point begin_;
  double power_up_ = 0.0;     ///< [s]
  double quiet_until_ = 0.0;  ///< [s]
  double off_until_ = 0.0;    ///< [s]
  bool plate_waits_ = false;  ///< runs with the next scan that somebody sees
  bool struck_ = false;       ///< faults that end connections strike once
  bool cycle_power_ = false;
  Counts counts_;
};

}  // namespace velum::emulator
