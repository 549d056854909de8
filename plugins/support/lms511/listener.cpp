// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/listener.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <list>
#include <map>
#include <system_error>

#include "velum/error.hpp"

namespace velum::lms511 {
namespace {

constexpr std::size_t kMostMessages = 100'000;
constexpr std::size_t kLongestLine = 4096;
constexpr int kSlice = 20;  // [ms]

struct Port {
  bool udp = false;
  std::uint16_t number = 0;
};

Port parse(std::string_view text) {
  Port port;
  port.udp = text.starts_with("udp:");
  const std::string_view digits = text.size() > 4 ? text.substr(4) : std::string_view();
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), port.number);
  if ((!port.udp && !text.starts_with("tcp:")) || result.ec != std::errc() ||
      result.ptr != digits.data() + digits.size() || port.number == 0)
    throw Error(Fault::graph, fmt::format("'{}' is no port, expected udp:PORT or tcp:PORT", text));
  return port;
}

Handle open_port(const Port& port) {
  const int type = port.udp ? SOCK_DGRAM : SOCK_STREAM;
  Handle handle(::socket(AF_INET6, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int on = 1;
  const int off = 0;
  ::setsockopt(handle.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  ::setsockopt(handle.get(), IPPROTO_IPV6, IPV6_V6ONLY, &off, sizeof(off));
  sockaddr_in6 six{};
  six.sin6_family = AF_INET6;
  six.sin6_port = htons(port.number);
  sockaddr_in four{};
  four.sin_family = AF_INET;
  four.sin_port = htons(port.number);
  bool bound = ::bind(handle.get(), reinterpret_cast<sockaddr*>(&six), sizeof(six)) == 0;  // NOLINT
  if (!bound && errno != EADDRINUSE) {  // a machine without IPv6
    handle = Handle(::socket(AF_INET, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    ::setsockopt(handle.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
    bound = ::bind(handle.get(), reinterpret_cast<sockaddr*>(&four), sizeof(four)) == 0;  // NOLINT
  }
  if (!bound || (!port.udp && ::listen(handle.get(), 4) != 0))
    throw Error(Fault::device, fmt::format("port {} cannot be had: {}", port.number,
                                           std::generic_category().message(errno)));
  return handle;
}

// One client of a TCP port and the line that it is sending.
struct Client {
  Handle handle;
  std::string line;
};

}  // namespace

void Listener::check(std::string_view port) {
  static_cast<void>(parse(port));
}

std::shared_ptr<Listener> Listener::at(const std::string& port) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<Listener>> all;
  const std::lock_guard lock(mutex);
  std::shared_ptr<Listener> listener = all[port].lock();
  if (!listener) {
    listener = std::make_shared<Listener>(port);
    all[port] = listener;
  }
  return listener;
}

Listener::Listener(const std::string& port) : handle_(open_port(parse(port))) {
  const bool udp = parse(port).udp;
  thread_ = std::thread([this, udp] { udp ? hear_datagrams() : hear_lines(); });
}

Listener::~Listener() {
  stop_ = true;
  thread_.join();
}

void Listener::note(std::string text) {
  const auto arrival = SteadyClock::now();
  const std::lock_guard lock(mutex_);
  if (messages_.size() == kMostMessages) {
    constexpr std::size_t kOld = kMostMessages / 10;
    messages_.erase(messages_.begin(), messages_.begin() + kOld);
    dropped_ += kOld;
  }
  messages_.push_back({arrival, std::move(text)});
}

std::vector<Listener::Message> Listener::since(std::uint64_t& seen) const {
  const std::lock_guard lock(mutex_);
  const std::uint64_t first = std::max(seen, dropped_) - dropped_;
  seen = dropped_ + messages_.size();
  return {messages_.begin() + static_cast<std::ptrdiff_t>(first), messages_.end()};
}

std::uint64_t Listener::count() const {
  const std::lock_guard lock(mutex_);
  return dropped_ + messages_.size();
}

void Listener::hear_datagrams() {
  std::array<char, kLongestLine> buffer{};
  while (!stop_) {
    pollfd one{handle_.get(), POLLIN, 0};
    if (::poll(&one, 1, kSlice) <= 0) continue;
    const ssize_t size = ::recv(handle_.get(), buffer.data(), buffer.size(), 0);
    if (size >= 0) note(std::string(buffer.data(), static_cast<std::size_t>(size)));
  }
}

void Listener::hear_lines() {
  std::list<Client> clients;
  std::array<char, kLongestLine> buffer{};
  constexpr std::size_t kMostClients = 16;
  while (!stop_) {
    std::vector<pollfd> polled = {{handle_.get(), POLLIN, 0}};
    for (const Client& client : clients) polled.push_back({client.handle.get(), POLLIN, 0});
    if (::poll(polled.data(), polled.size(), kSlice) <= 0) continue;
    std::size_t at = 1;
    for (auto client = clients.begin(); client != clients.end(); ++at) {
      bool closed = false;
      if (polled[at].revents != 0) {
        const ssize_t size = ::recv(client->handle.get(), buffer.data(), buffer.size(), 0);
        closed = size == 0 || (size < 0 && errno != EAGAIN && errno != EINTR);
        if (size > 0) client->line.append(buffer.data(), static_cast<std::size_t>(size));
        for (std::size_t end = 0; (end = client->line.find('\n')) != std::string::npos;) {
          note(client->line.substr(0, end));
          client->line.erase(0, end + 1);
        }
        if (client->line.size() > kLongestLine) closed = true;
        if (closed && !client->line.empty()) note(client->line);
      }
      client = closed ? clients.erase(client) : std::next(client);
    }
    if (polled.front().revents != 0 && clients.size() < kMostClients) {
      Handle fresh(::accept4(handle_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
      if (fresh.get() >= 0) clients.push_back({std::move(fresh), ""});
    }
  }
}

struct Rendezvous::Group {
  std::mutex mutex;
  int expected = 0;
  int present = 0;
  std::optional<SteadyClock::time_point> begun;
};

Rendezvous::Rendezvous(std::string name, int count) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<Group>> all;
  const std::lock_guard lock(mutex);
  group_ = all[name].lock();
  if (!group_ || group_->begun) {
    group_ = std::make_shared<Group>();
    group_->expected = count;
    all[name] = group_;
  }
  const std::lock_guard group_lock(group_->mutex);
  if (++group_->present == group_->expected) group_->begun = SteadyClock::now();
}

std::optional<SteadyClock::time_point> Rendezvous::begun() const {
  const std::lock_guard lock(group_->mutex);
  return group_->begun;
}

int Rendezvous::present() const {
  const std::lock_guard lock(group_->mutex);
  return group_->present;
}

}  // namespace velum::lms511
