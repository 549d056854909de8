// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <optional>

#include "test_trials.hpp"

// A hundred random starts of every case, each case a test of its own (label long).

using namespace velum::registration::test;

namespace {

constexpr std::uint64_t kStarts = 100;

/// At least `least` of the starts are right, and none of the others is given out as a success.
void hundred(const std::optional<Pair>& pair, int least) {
  if (!pair) {
    WARN("skipped: no shared data");
    return;
  }
  int right = 0;
  int wrong = 0;
  for (std::uint64_t seed = 1; seed <= kStarts; ++seed) {
    const Trial one = trial(*pair, random_frame(*pair, seed));
    right += one.right ? 1 : 0;
    wrong += !one.right && !one.refused ? 1 : 0;
    if (!one.right) WARN("start " << seed << ": " << one.text);
  }
  CHECK(right >= least);
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("a hundred starts: whole", "[.][long]") {
  hundred(whole(), 99);
}

TEST_CASE("a hundred starts: part", "[.][long]") {
  hundred(part(), 99);
}

TEST_CASE("a hundred starts: corner", "[.][long]") {
  hundred(corner(), 99);
}

// Refusing is the right answer to most of these: 32 were right, 68 refused.
TEST_CASE("a hundred starts: strip", "[.][long]") {
  hundred(strip(), 25);
}

TEST_CASE("a hundred starts: bunny_045", "[.][long]") {
  hundred(bunny_pair("000", "045"), 99);
}

TEST_CASE("a hundred starts: bunny_090", "[.][long]") {
  hundred(bunny_pair("000", "090"), 99);
}

TEST_CASE("a hundred starts: bunny_045_090", "[.][long]") {
  hundred(bunny_pair("045", "090"), 99);
}

TEST_CASE("a hundred starts: street", "[.][long]") {
  hundred(street_pair(), 99);
}

TEST_CASE("a hundred starts: kitchen", "[.][long]") {
  hundred(kitchen_pair(), 99);
}

TEST_CASE("a hundred starts: tunnel", "[.][long]") {
  hundred(tunnel(), 95);
}
