// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/testing.hpp>

#include "timing.hpp"

/// What the files of our own contenders share.
namespace bench {

/// The same points without what was learnt of them: the neighbour index is made anew.
inline velum::Cloud fresh(const velum::Cloud& cloud) {
  return cloud.with_positions(velum::Points(cloud.positions()));
}

inline std::string metres(double length) {
  return std::to_string(length) + " m";
}

using Make = std::function<velum::test::Stage(const Input&)>;

/// A stage on one cloud of the input, with `threads` threads.
inline Contender stage(const std::string& operation, int threads, velum::Cloud Input::*cloud,
                       const Make& make) {
  return {operation, threads == 1 ? "Velum, 1 thread" : "Velum", [=](const Input& input) {
            return [stage = make(input).threads(threads), work = fresh(input.*cloud)]() mutable {
              stage.run(work);
            };
          }};
}

}  // namespace bench
