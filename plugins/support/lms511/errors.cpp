// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/errors.hpp"

#include <fmt/format.h>

#include <array>

namespace velum::lms511 {
namespace {

constexpr std::array<std::string_view, 27> kMeanings = {
    "no error",
    "access denied: the method needs a higher user level",
    "the method is unknown",
    "the variable is unknown",
    "a value is out of its range",
    "the request's data are invalid",
    "an unknown error",
    "the request has too many bytes",
    "the request has too few parameters",
    "a parameter has the wrong type",
    "write access denied: the variable needs a higher user level",
    "the kind of command is unknown",
    "the command is unknown",
    "the device is busy",
    "an index is out of bounds",
    "the event is unknown",
    "a value is too large for its type",
    "an invalid character",
    "the device has no message",
    "the device has no answer",
    "an internal error",
    "a wrong hub address",
    "the hub cannot decode the telegram",
    "a wrong length at the hub",
    "the hub's time has expired",
    "asynchronous methods are suppressed",
    "complex arrays are not supported",
};

}  // namespace

std::string_view meaning(ErrorCode code) {
  const auto number = static_cast<std::size_t>(code);
  return number < kMeanings.size() ? kMeanings[number] : "a code that is not listed";
}

std::string in_words(ErrorCode code) {
  return fmt::format("sFA {:X} ({})", static_cast<unsigned>(code), meaning(code));
}

Malformed::Malformed(ErrorCode code, const std::string& message, std::size_t offset)
    : Error(Error(Fault::input, message).at(fmt::format("telegram: byte {}", offset))),
      code_(code) {}

}  // namespace velum::lms511
