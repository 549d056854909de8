// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/socket.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <memory>
#include <system_error>

#include "velum/error.hpp"

namespace velum::lms511 {
namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

std::uint16_t parse_port(std::string_view text) {
  std::uint16_t port = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), port);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size() || port == 0)
    throw Error(Fault::graph, fmt::format("'{}' is no port, expected 1 to 65535", text));
  return port;
}

struct FreeAddresses {
  void operator()(addrinfo* list) const { ::freeaddrinfo(list); }
};

std::unique_ptr<addrinfo, FreeAddresses> addresses_of(const Endpoint& endpoint) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  const int failed =
      ::getaddrinfo(endpoint.host.c_str(), std::to_string(endpoint.port).c_str(), &hints, &list);
  if (failed != 0)
    throw ConnectionLost(
        fmt::format("the name '{}' is not known: {}", endpoint.host, ::gai_strerror(failed)));
  return std::unique_ptr<addrinfo, FreeAddresses>(list);
}

// Nothing on success, else why not.
std::string connect_to(const addrinfo& address, int descriptor, double seconds,
                       const Interrupt& interrupt) {
  if (::connect(descriptor, address.ai_addr, address.ai_addrlen) == 0) return "";
  if (errno != EINPROGRESS) return reason(errno);
  if (!wait_for(descriptor, POLLOUT, seconds, interrupt)) return "no answer";
  int error = 0;
  socklen_t size = sizeof(error);
  ::getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &size);
  return error == 0 ? "" : reason(error);
}

}  // namespace

Endpoint parse_endpoint(std::string_view text, std::uint16_t default_port) {
  Endpoint endpoint{std::string(text), default_port};
  const std::size_t colon = text.rfind(':');
  if (text.starts_with("[")) {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos)
      throw Error(Fault::graph, fmt::format("'{}' is no address", text));
    endpoint.host = text.substr(1, end - 1);
    if (end + 1 < text.size() && text[end + 1] == ':')
      endpoint.port = parse_port(text.substr(end + 2));
  } else if (colon != std::string_view::npos && text.find(':') == colon) {
    endpoint.host = text.substr(0, colon);
    endpoint.port = parse_port(text.substr(colon + 1));
  }
  if (endpoint.host.empty()) throw Error(Fault::graph, "the address is empty");
  return endpoint;
}

std::string in_words(const Endpoint& endpoint) {
  const bool six = endpoint.host.find(':') != std::string::npos;
  return fmt::format("{}{}{}:{}", six ? "[" : "", endpoint.host, six ? "]" : "", endpoint.port);
}

Handle::~Handle() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool wait_for(int descriptor, short events, double seconds, const Interrupt& interrupt) {
  constexpr int kSlice = 50;  // [ms]
  const auto end = SteadyClock::now() + std::chrono::duration<double>(std::max(seconds, 0.0));
  while (true) {
    interrupt();
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - SteadyClock::now());
    const int slice = static_cast<int>(std::clamp<std::int64_t>(left.count() + 1, 0, kSlice));
    pollfd one{descriptor, events, 0};
    const int ready = ::poll(&one, 1, slice);
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) throw ConnectionLost(reason(errno));
    if (SteadyClock::now() >= end) return false;
  }
}

TcpSocket::TcpSocket(Handle handle) : handle_(std::move(handle)) {
  constexpr std::size_t kBuffer = std::size_t{256} << 10U;
  buffer_.resize(kBuffer);
}

TcpSocket TcpSocket::connect(const Endpoint& endpoint, double seconds, const Interrupt& interrupt) {
  const auto list = addresses_of(endpoint);
  std::string why = "no address";
  for (const addrinfo* address = list.get(); address != nullptr; address = address->ai_next) {
    Handle handle(::socket(address->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (handle.get() < 0) {
      why = reason(errno);
      continue;
    }
    why = connect_to(*address, handle.get(), seconds, interrupt);
    if (!why.empty()) continue;
    const int on = 1;
    ::setsockopt(handle.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
    return TcpSocket(std::move(handle));
  }
  throw ConnectionLost(fmt::format("{} cannot be reached: {}", in_words(endpoint), why));
}

void TcpSocket::send(std::string_view bytes, double seconds, const Interrupt& interrupt) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(handle_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (!wait_for(handle_.get(), POLLOUT, seconds, interrupt))
        throw ConnectionLost("the device takes no requests");
    } else if (errno != EINTR) {
      throw ConnectionLost(fmt::format("the connection broke: {}", reason(errno)));
    }
  }
}

std::string_view TcpSocket::receive(double seconds, const Interrupt& interrupt) {
  if (!wait_for(handle_.get(), POLLIN, seconds, interrupt)) return {};
  const ssize_t size = ::recv(handle_.get(), buffer_.data(), buffer_.size(), 0);
  if (size > 0) return std::string_view(buffer_).substr(0, static_cast<std::size_t>(size));
  if (size == 0) throw ConnectionLost("the device closed the connection");
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return {};
  throw ConnectionLost(fmt::format("the connection broke: {}", reason(errno)));
}

}  // namespace velum::lms511
