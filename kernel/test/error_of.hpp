// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <catch2/catch.hpp>
#include <stdexcept>

#include "velum/error.hpp"

namespace velum::test {

/// The error with which `attempt` ends.
template <class Attempt>
Error error_of(const Attempt& attempt) {
  try {
    attempt();
  } catch (const Error& error) {
    return error;
  }
  FAIL("no error");
  throw std::logic_error("unreachable");
}

}  // namespace velum::test
