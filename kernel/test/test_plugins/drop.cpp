// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Keeps the points up to a height: none, when it is low.
#include <velum/stage.hpp>

namespace {

struct Drop {
  velum::Length above = 2.0;
  velum::Length slack = 1e-6;

  static auto about() {
    return velum::About<Drop>("Drops what is high.")
        .in("cloud")
        .out("cloud")
        .out("dropped")
        .param(&Drop::above, "above", "highest z that stays", velum::anything())
        .param(&Drop::slack, "slack", "this much more stays, too", velum::above(0.0));
  }
  std::tuple<velum::Cloud, velum::Cloud> operator()(const velum::Cloud& cloud,
                                                    velum::Context&) const {
    std::vector<std::int32_t> kept;
    std::vector<std::int32_t> dropped;
    for (velum::Index i = 0; i < cloud.size(); ++i)
      (cloud.positions()(2, i) <= static_cast<float>(above + slack) ? kept : dropped)
          .push_back(static_cast<std::int32_t>(i));
    return {cloud.select(kept), cloud.select(dropped)};
  }
};

}  // namespace
VELUM_STAGE(Drop)
