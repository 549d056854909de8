// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <velum/testing.hpp>

#include "clouds.hpp"
#include "timing.hpp"

/// What the files of our own contenders share.
namespace bench {

using velum::test::Stage;
using Make = std::function<Stage(const Input&)>;
using CloudOf = velum::Cloud Input::*;

/// The same points without what was learnt of them: the neighbour index is made anew.
inline velum::Cloud fresh(const velum::Cloud& cloud) {
  return cloud.with_positions(velum::Points(cloud.positions()));
}

inline std::string metres(double length) {
  return std::to_string(length) + " m";
}

inline Contender own(const std::string& operation, Prepare prepare, velum::Index max_points = 0) {
  return {operation, "Velum", std::move(prepare), max_points};
}

/// A stage on one cloud of the input, with 2 threads.
inline Contender on_cloud(const std::string& operation, CloudOf cloud, const Make& make,
                          velum::Index max_points = 0) {
  return own(
      operation,
      [=](const Input& input) {
        return [stage = make(input), work = fresh(input.*cloud)]() mutable { stage.run(work); };
      },
      max_points);
}

/// A stage on two clouds of the input.
inline Contender on_pair(const std::string& operation, CloudOf first, CloudOf second,
                         const Make& make, velum::Index max_points = 0) {
  return own(
      operation,
      [=](const Input& input) {
        return [stage = make(input), a = fresh(input.*first), b = fresh(input.*second)]() mutable {
          stage.run(a, b);
        };
      },
      max_points);
}

/// The same with one thread, beside the row's first contender.
inline Contender single(Contender contender, const Make& make, CloudOf first,
                        CloudOf second = nullptr) {
  contender.name = "Velum, 1 thread";
  contender.prepare = [=](const Input& input) -> std::function<void()> {
    Stage stage = make(input).threads(1);
    if (second == nullptr)
      return [stage, work = fresh(input.*first)]() mutable { stage.run(work); };
    return
        [stage, a = fresh(input.*first), b = fresh(input.*second)]() mutable { stage.run(a, b); };
  };
  return contender;
}

/// Adds a stage with 2 threads and with 1.
inline void add_both(Contenders& all, const std::string& operation, CloudOf cloud, const Make& make,
                     velum::Index max_points = 0) {
  all.push_back(on_cloud(operation, cloud, make, max_points));
  all.push_back(single(all.back(), make, cloud));
}
inline void add_both(Contenders& all, const std::string& operation, CloudOf first, CloudOf second,
                     const Make& make, velum::Index max_points = 0) {
  all.push_back(on_pair(operation, first, second, make, max_points));
  all.push_back(single(all.back(), make, first, second));
}

}  // namespace bench
