// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "files/descriptor.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace velum::files {
namespace {

/// Linux moves at most 2 GiB in one call.
constexpr std::size_t kMostAtOnce = std::size_t{1} << 30U;

}  // namespace

Descriptor::~Descriptor() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::string reason(int error) {
  return std::generic_category().message(error);
}

std::size_t read_fully(int descriptor, std::span<std::byte> to) {
  std::size_t done = 0;
  while (done < to.size()) {
    const ssize_t got = ::read(descriptor, &to[done], std::min(to.size() - done, kMostAtOnce));
    if (got == 0) break;
    if (got > 0) {
      done += static_cast<std::size_t>(got);
    } else if (errno != EINTR) {
      throw std::system_error(errno, std::generic_category());
    }
  }
  return done;
}

void write_fully(int descriptor, std::span<const std::byte> from) {
  while (!from.empty()) {
    const ssize_t put = ::write(descriptor, from.data(), std::min(from.size(), kMostAtOnce));
    if (put >= 0) {
      from = from.subspan(static_cast<std::size_t>(put));
    } else if (errno != EINTR) {
      throw std::system_error(errno, std::generic_category());
    }
  }
}

}  // namespace velum::files
