// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "emulator/faults.hpp"

#include <algorithm>

namespace velum::emulator {
namespace {

constexpr std::uint64_t kEvery = 10;
constexpr int kFlood = 300;
constexpr std::size_t kDrop = 256;
constexpr double kDripPause = 0.001;
constexpr double kSplitPause = 0.002;

Delivery drip(const std::string& frame) {
  Delivery delivery;
  delivery.pause = kDripPause;
  for (std::size_t at = 0; at < frame.size(); at += kDrop)
    delivery.pieces.push_back(frame.substr(at, kDrop));
  return delivery;
}

Delivery split(const std::string& frame, std::uint64_t number) {
  const std::size_t at = 1 + number % (frame.size() - 1);
  return {{frame.substr(0, at), frame.substr(at)}, kSplitPause};
}

// A length that is too long by a few bytes swallows the head of the next telegram.
std::string with_wrong_length(std::string frame, lms511::Dialect dialect) {
  constexpr std::size_t kLowestLengthByte = 7;
  if (dialect == lms511::Dialect::binary)
    frame[kLowestLengthByte] = static_cast<char>(frame[kLowestLengthByte] ^ 0x15);
  else
    frame.pop_back();
  return frame;
}

std::string with_wrong_byte(std::string frame) {
  char& byte = frame[frame.size() / 2];
  byte = static_cast<char>(byte ^ 0x41);
  return frame;
}

std::string garbage(Random& random) {
  std::string bytes(static_cast<std::size_t>(1 + random.below(64)), '\0');
  for (char& byte : bytes) byte = static_cast<char>(random.below(256));
  return bytes;
}

Delivery flooded(const std::string& frame, const std::string& event) {
  std::string all = frame;
  for (int i = 0; i < kFlood; ++i) all += event;
  return {{std::move(all)}};
}

}  // namespace

Delivery deliver(const Fault& fault, std::uint64_t number, lms511::Dialect dialect,
                 std::string frame, const std::string& event, Random random) {
  const bool tenth = number % kEvery == kEvery - 1;
  if (number < fault.after) return {{std::move(frame)}};
  switch (fault.kind) {
    case FaultKind::silence:
      return {};
    case FaultKind::split:
      return split(frame, number);
    case FaultKind::drip:
      return drip(frame);
    case FaultKind::half:
      return {{frame.substr(0, frame.size() / 2)}, 0.0, Delivery::Then::close};
    case FaultKind::length:
      return {{tenth ? with_wrong_length(std::move(frame), dialect) : std::move(frame)}};
    case FaultKind::checksum:
      return {{tenth ? with_wrong_byte(std::move(frame)) : std::move(frame)}};
    case FaultKind::garbage:
      return {{garbage(random) + frame}};
    case FaultKind::flood:
      return flooded(frame, event);
    case FaultKind::gap:
      return tenth ? Delivery{} : Delivery{{std::move(frame)}};
    case FaultKind::reset:
      return {{}, 0.0, Delivery::Then::reset};
    case FaultKind::power_cycle:
      return {{}, 0.0, Delivery::Then::power_cycle};
    default:
      return {{std::move(frame)}};
  }
}

}  // namespace velum::emulator
