// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "emulator/server.hpp"

#include <poll.h>

#include <algorithm>
#include <utility>

namespace velum::emulator {
namespace {

// From the subscription to the first scan, as real devices take it [us].
constexpr double kFirstScan = 200'000.0;
constexpr double kPatience = 0.05;       // longest wait [s]: interruptions must be seen
constexpr double kOff = 1.0;             // how long a power cycle takes [s]
constexpr int kBurst = 16;               // most revolutions between two looks at the clients
constexpr std::size_t kAhead = 262'144;  // bytes that wait for a client when going flat out
constexpr std::uint16_t kPorts = 2;

double since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

Server::Server(const ServerOptions& options, const Device& device, const View& view,
               const Plate& plate, const Random& random)
    : options_(options),
      delivered_(device),
      device_(device),
      view_(view),
      plate_(plate),
      random_(random),
      begin_(std::chrono::steady_clock::now()) {
  ports_ = {options.port, static_cast<std::uint16_t>(options.port == 0 ? 0 : options.port + 1)};
  listen();
  for (std::size_t i = 0; i < kPorts; ++i) ports_[i] = listeners_[i].port();
  revolutions_.emplace(device_, view_, plate_);
}

void Server::listen() {
  listeners_.clear();
  for (const std::uint16_t port : ports_) listeners_.emplace_back(options_.address, port);
}

double Server::now() const {
  return since(begin_);
}

// Flat out, time is what the revolutions say.
double Server::clock() const {
  return flat_out() ? device_.clock : 1e6 * options_.speed * (now() - power_up_);
}

bool Server::finished() const {
  if (options_.lifetime > 0.0 && now() >= options_.lifetime) return true;
  return options_.sessions > 0 && clients_.empty() &&
         counts_.connections >= static_cast<std::uint64_t>(options_.sessions);
}

void Server::run(Context& context) {
  while (!finished()) {
    context.check();
    wait();
    if (listeners_.empty()) {
      if (now() < off_until_) continue;
      listen();
    }
    accept_clients();
    if (!quiet()) {
      read_clients();
      turn();
    }
    write_clients();
    if (cycle_power_) power_cycle();
  }
}

// How long nothing can happen by itself [s].
double Server::patience() const {
  double wait = kPatience;
  for (const auto& client : clients_) {
    const double pause = client->not_before() - now();
    if (client->waiting() > 0 && pause > 0.0) wait = std::min(wait, pause);
  }
  if (quiet()) return std::max(0.0, std::min(wait, quiet_until_ - now()));
  const bool somebody = std::any_of(clients_.begin(), clients_.end(), [](const auto& client) {
    return client->session.scans && !client->mute;
  });
  if (somebody && flat_out()) return may_turn() ? 0.0 : std::max(0.0, wait);
  if (somebody) wait = std::min(wait, (revolutions_->due() - clock()) * 1e-6 / options_.speed);
  return std::max(0.0, wait);
}

void Server::wait() {
  std::vector<pollfd> all;
  for (const Listener& listener : listeners_) all.push_back({listener.descriptor(), POLLIN, 0});
  const double time = now();
  for (const auto& client : clients_) {
    const bool out = client->wants_out(time);
    const bool in = !quiet() && client->listens();
    const auto events = static_cast<short>((in ? POLLIN : 0) | (out ? POLLOUT : 0));
    all.push_back({client->descriptor(), events, 0});
  }
  // Rounded up to the next millisecond, or it would spin.
  const double wait = patience();
  const int milliseconds = wait <= 0.0 ? 0 : static_cast<int>(wait * 1e3) + 1;
  static_cast<void>(::poll(all.data(), all.size(), milliseconds));
}

void Server::accept_clients() {
  for (std::size_t i = 0; i < listeners_.size(); ++i) {
    const auto dialect = i == 0 ? lms511::Dialect::ascii : device_.host_dialect;
    for (Descriptor caller = listeners_[i].accept(); caller.open();
         caller = listeners_[i].accept()) {
      if (options_.fault.kind == FaultKind::busy && !clients_.empty()) continue;
      ++counts_.connections;
      clients_.push_back(std::make_unique<Client>(std::move(caller), dialect));
    }
  }
}

void Server::read_clients() {
  device_.clock = clock();
  for (auto& client : clients_) {
    if (client->closing || !client->listens()) continue;
    if (!client->receive()) {
      client.reset();
      continue;
    }
    while (client->listens()) {
      const auto telegram = client->request();
      if (!telegram) break;
      handle(*client, *telegram);
    }
  }
  std::erase(clients_, nullptr);
}

void Server::handle(Client& client, const lms511::Telegram& telegram) {
  ++counts_.requests;
  const Fault& fault = options_.fault;
  if (fault.kind == FaultKind::silence && client.scans >= fault.after) client.mute = true;
  const lms511::Dialect dialect = telegram.dialect;
  Answer answered = answer(device_, telegram, client.session);
  if (client.mute) return;
  client.send(std::move(answered.frame));
  apply(answered.effect, client, dialect);
}

void Server::apply(Effect effect, Client& client, lms511::Dialect dialect) {
  switch (effect) {
    case Effect::none:
      return;
    case Effect::scan:
      revolutions_->pass_until(clock());
      client.send(lms511::framed(dialect, lms511::encode_scan(revolutions_->last(), dialect)));
      return;
    case Effect::scans_on:
      revolutions_->pass_until(clock());
      client.scans_from = clock() + (flat_out() ? 0.0 : kFirstScan);
      if (revolutions_->plate_rests()) plate_waits_ = true;
      return;
    case Effect::outputs_on:
      // Real devices send it twice.
      for (int i = 0; i < 2; ++i) client.send(outputs_event(device_, dialect));
      return;
    case Effect::speed:
      quiet_until_ = now() + options_.settling;
      return;
    case Effect::reboot:
      cycle_power_ = true;
      return;
  }
}

// Does the client get the current revolution?
bool Server::awaited(const Client& client) const {
  return client.session.scans && !client.closing && !client.mute &&
         revolutions_->due() >= client.scans_from;
}

bool Server::may_turn() const {
  if (!device_.measuring) return false;
  if (!flat_out()) return revolutions_->due() <= clock();
  return std::all_of(clients_.begin(), clients_.end(), [&](const auto& client) {
    return !awaited(*client) || client->waiting() < kAhead;
  });
}

void Server::turn() {
  for (int i = 0; i < kBurst && !cycle_power_; ++i) {
    const bool somebody = std::any_of(clients_.begin(), clients_.end(),
                                      [&](const auto& client) { return awaited(*client); });
    if (!somebody) {
      if (!flat_out()) revolutions_->pass_until(clock());
      return;
    }
    if (!may_turn()) return;
    send_scan();
  }
}

void Server::send_scan() {
  // The scan with the laser off is of no use: the plate runs from the next one on.
  if (std::exchange(device_.switched_on, false))
    revolutions_->mark_switched_on();
  else if (std::exchange(plate_waits_, false))
    revolutions_->start_plate();
  device_.clock = revolutions_->due();
  std::vector<Client*> takers;
  for (const auto& client : clients_)
    if (awaited(*client)) takers.push_back(client.get());
  const auto scan = revolutions_->next();
  if (!scan) return;
  std::array<std::string, 2> frames;
  for (Client* client : takers) {
    const lms511::Dialect dialect = client->session.dialect;
    std::string& frame = frames[dialect == lms511::Dialect::ascii ? 0 : 1];
    if (frame.empty()) frame = lms511::framed(dialect, lms511::encode_scan(*scan, dialect));
    give(*client, frame);
  }
}

void Server::give(Client& client, const std::string& frame) {
  const std::uint64_t number = client.scans++;
  if (client.waiting() > Client::kRoom) {
    ++counts_.dropped;
    return;
  }
  const lms511::Dialect dialect = client.session.dialect;
  Fault fault = options_.fault;
  if (struck_) fault.kind = FaultKind::none;
  Delivery delivery = deliver(fault, number, dialect, frame, outputs_event(device_, dialect),
                              random_.split(number));
  if (!delivery.pieces.empty()) ++counts_.scans;
  for (std::string& piece : delivery.pieces) client.send(std::move(piece), delivery.pause);
  if (delivery.then == Delivery::Then::go_on) return;
  struck_ = true;
  client.closing = true;
  if (delivery.then == Delivery::Then::reset) client.reset();
  cycle_power_ = delivery.then == Delivery::Then::power_cycle;
}

void Server::write_clients() {
  const double time = now();
  for (auto& client : clients_) {
    const bool gone = client->descriptor() < 0 || !client->flush(time);
    if (gone || (client->closing && client->waiting() == 0)) client.reset();
  }
  std::erase(clients_, nullptr);
}

// Everything is as after power-up; the ports are shut for a while.
void Server::power_cycle() {
  cycle_power_ = false;
  clients_.clear();
  listeners_.clear();
  device_ = delivered_;
  off_until_ = now() + kOff;
  power_up_ = off_until_;
  plate_waits_ = false;
  revolutions_.emplace(device_, view_, plate_);
}

}  // namespace velum::emulator
