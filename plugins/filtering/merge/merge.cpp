// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <set>
#include <velum/stage.hpp>

namespace {

struct Merge {
  static auto about() {
    return velum::About<Merge>("All points of several clouds of one frame as one cloud.")
        .in("clouds", "in the order in which their points are to stand")
        .out("cloud", "with the columns that all of them have, and all their sensors")
        .deterministic();
  }

  velum::Cloud operator()(const std::vector<velum::Cloud>& clouds, velum::Context& context) const {
    context.check();
    std::set<std::string> lost;
    for (const velum::Cloud& cloud : clouds)
      for (const auto& [name, column] : cloud.columns())
        for (const velum::Cloud& other : clouds)
          if (!other.has(name)) lost.insert(name);
    // Where points lack a sensor column while sensors exist, the kernel knows which one it was.
    lost.erase(velum::column::kSensor);
    for (const std::string& name : lost)
      context.warn(fmt::format("column '{}' is left out: not all clouds have it", name));
    velum::Cloud cloud = velum::merge(clouds);
    context.measure("points", static_cast<double>(cloud.size()), "");
    return cloud;
  }
};

}  // namespace
VELUM_STAGE(Merge)
