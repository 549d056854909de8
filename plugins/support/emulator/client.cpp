// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "emulator/client.hpp"

#include <sys/socket.h>

#include <array>
#include <cerrno>

namespace velum::emulator {
namespace {

constexpr std::size_t kPacket = 65536;
// Pieces up to this size are joined, so that the queue has few of them.
constexpr std::size_t kJoined = 16384;

bool would_block() {
  return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
}

}  // namespace

bool Client::receive() {
  std::array<char, kPacket> bytes;  // NOLINT: filled by recv
  const auto count = ::recv(socket_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count == 0) return false;
  if (count < 0) return would_block();
  framer_.feed({bytes.data(), static_cast<std::size_t>(count)});
  return true;
}

void Client::send(std::string bytes, double pause) {
  if (bytes.empty()) return;
  waiting_ += bytes.size();
  if (pause == 0.0 && !out_.empty() && out_.back().pause == 0.0 &&
      out_.back().bytes.size() < kJoined)
    out_.back().bytes += bytes;
  else
    out_.push_back({std::move(bytes), pause});
}

bool Client::flush(double now) {
  while (!out_.empty() && now >= not_before_) {
    const Piece& piece = out_.front();
    const auto count = ::send(socket_.get(), piece.bytes.data() + sent_, piece.bytes.size() - sent_,
                              MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0) return would_block();
    sent_ += static_cast<std::size_t>(count);
    waiting_ -= static_cast<std::size_t>(count);
    if (sent_ < piece.bytes.size()) return true;
    if (piece.pause > 0.0) not_before_ = now + piece.pause;
    out_.pop_front();
    sent_ = 0;
  }
  return true;
}

}  // namespace velum::emulator
