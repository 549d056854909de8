// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "emulator/sockets.hpp"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <system_error>

#include "velum/error.hpp"

namespace velum::emulator {
namespace {

std::string reason() {
  return std::generic_category().message(errno);
}

[[noreturn]] void refuse(const std::string& address, std::uint16_t port, const std::string& why) {
  throw Error(Fault::device,
              "cannot listen on " + address + " port " + std::to_string(port) + ": " + why)
      .hint("take another `port`, or end the program that has it");
}

struct FreeAddresses {
  void operator()(addrinfo* list) const { freeaddrinfo(list); }
};
using Addresses = std::unique_ptr<addrinfo, FreeAddresses>;

Addresses resolve(const std::string& address, std::uint16_t port) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int failure = getaddrinfo(address.c_str(), std::to_string(port).c_str(), &wanted, &found);
  if (failure != 0) refuse(address, port, gai_strerror(failure));
  return Addresses(found);
}

std::uint16_t port_of(int socket) {
  sockaddr_storage own{};
  socklen_t size = sizeof(own);
  // The socket interface wants its addresses cast.
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&own), &size) != 0) return 0;  // NOLINT
  const auto port = own.ss_family == AF_INET6
                        ? reinterpret_cast<const sockaddr_in6*>(&own)->sin6_port  // NOLINT
                        : reinterpret_cast<const sockaddr_in*>(&own)->sin_port;   // NOLINT
  return ntohs(port);
}

}  // namespace

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

Listener::Listener(const std::string& address, std::uint16_t port) {
  const Addresses addresses = resolve(address, port);
  socket_ = Descriptor(
      ::socket(addresses->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, IPPROTO_TCP));
  const int yes = 1;
  if (!socket_.open() ||
      ::setsockopt(socket_.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes)) != 0 ||
      ::bind(socket_.get(), addresses->ai_addr, addresses->ai_addrlen) != 0 ||
      ::listen(socket_.get(), SOMAXCONN) != 0)
    refuse(address, port, reason());
  port_ = port_of(socket_.get());
}

Descriptor Listener::accept() const {
  Descriptor client(::accept4(socket_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!client.open()) return client;
  const int yes = 1;
  ::setsockopt(client.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
  return client;
}

void reset(Descriptor socket) {
  const linger hard{.l_onoff = 1, .l_linger = 0};
  ::setsockopt(socket.get(), SOL_SOCKET, SO_LINGER, &hard, sizeof(hard));
}

}  // namespace velum::emulator
