// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Takes its time: listens to an interruption, or does not.
#include <chrono>
#include <thread>
#include <velum/stage.hpp>

namespace {

struct Slow {
  velum::Duration time{0.2};
  bool stubborn = false;

  static auto about() {
    return velum::About<Slow>("Waits, then gives its cloud back.")
        .in("cloud")
        .out("cloud")
        .param(&Slow::time, "time", "how long", velum::at_least(0.0))
        .param(&Slow::stubborn, "stubborn", "does not listen to an interruption");
  }
  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    using Clock = std::chrono::steady_clock;
    const auto began = Clock::now();
    double passed = 0.0;
    while (passed < time.seconds) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      if (!stubborn) context.check();
      passed = std::chrono::duration<double>(Clock::now() - began).count();
      context.progress(passed / time.seconds);
    }
    return cloud;
  }
};

}  // namespace
VELUM_STAGE(Slow)
