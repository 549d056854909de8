// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Breaks, on request, one of the promises that test::conformance() looks for.
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <velum/stage.hpp>

namespace {

enum class How { nothing, foreign, unsteady, threads, normals, column, measure, cancels, stubborn };

struct Misbehaves {
  How how = How::nothing;

  static auto about() {
    return velum::About<Misbehaves>("Does not keep its promises.")
        .in("cloud")
        .out("cloud")
        .needs("cloud", "intensity")
        .adds("cloud", "normals")
        .choice(&Misbehaves::how, "how", "what it does wrong",
                {{"nothing", How::nothing, "nothing"},
                 {"foreign", How::foreign, "throws a std::exception for few points"},
                 {"unsteady", How::unsteady, "gives another result each time"},
                 {"threads", How::threads, "gives another result with another number of threads"},
                 {"normals", How::normals, "makes normals that are not of unit length"},
                 {"column", How::column, "does not add what it says"},
                 {"measure", How::measure, "measures NaN"},
                 {"cancels", How::cancels, "says that it was cancelled"},
                 {"stubborn", How::stubborn, "throws what is no exception when cancelled"}});
  }

  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    static std::atomic<float> calls = 0.0F;
    if (how == How::foreign && cloud.size() < 3) throw std::out_of_range("no third point");
    if (how == How::measure) context.measure("size", std::nan(""), "");
    if (how == How::cancels) throw velum::Cancelled();
    if (how == How::stubborn && context.cancelled()) throw 42;  // NOLINT
    if (how == How::column) return cloud.without("normals");
    velum::Points normals = velum::Points::Zero(3, cloud.size());
    normals.row(2).setConstant(how == How::normals ? 2.0F : 1.0F);
    velum::Cloud made = cloud.with("normals", velum::Column(normals));
    float value = 0.0F;
    if (how == How::unsteady) value = (calls = calls + 1.0F);
    if (how == How::threads) value = static_cast<float>(context.threads());
    return made.with(
        "value", velum::Column(Eigen::VectorXf(Eigen::VectorXf::Constant(cloud.size(), value))));
  }
};

}  // namespace
VELUM_STAGE(Misbehaves)
