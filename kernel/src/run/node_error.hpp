// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <string>
#include <utility>

#include "velum/error.hpp"

namespace velum::run {

/// An error whose code says more than its fault does.
class CodedError : public Error {
 public:
  CodedError(Fault fault, std::string code, const std::string& message,
             const std::string& hint = "")
      : Error(Error(fault, message).hint(hint)), code_(std::move(code)) {}
  [[nodiscard]] const std::string& code() const noexcept { return code_; }

 private:
  std::string code_;
};

inline constexpr const char* kEmptyResult = "E1002";
inline constexpr const char* kCrashed = "E1003";
inline constexpr const char* kTooLong = "E1004";
inline constexpr const char* kTooMuchMemory = "E1005";

/// A node has no results; its record tells why.
class Stopped : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "a node has no results"; }
};

}  // namespace velum::run
