// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Brings its process down, or into trouble.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <thread>
#include <velum/stage.hpp>

namespace {

enum class How { segv, abort, leave, endless, memory, not_at_all };

struct Crash {
  How how = How::segv;

  static auto about() {
    return velum::About<Crash>("Crashes.")
        .in("cloud")
        .out("cloud")
        .choice(&Crash::how, "how", "it goes down",
                {{"segv", How::segv, "by a signal"},
                 {"abort", How::abort, "by abort()"},
                 {"leave", How::leave, "by _Exit(3)"},
                 {"endless", How::endless, "never returns"},
                 {"memory", How::memory, "takes 400 MB, then waits"},
                 {"not_at_all", How::not_at_all, "gives its cloud back"}});
  }
  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    using std::chrono::seconds;
    context.info("going down");
    context.progress(0.5);
    context.measure("depth", 7.0, "m");
    context.warn("mind the gap");
    std::unique_ptr<char[]> memory;
    switch (how) {
      case How::segv:
        std::signal(SIGSEGV, SIG_DFL);
        std::raise(SIGSEGV);
        break;
      case How::abort:
        std::abort();
      case How::leave:
        std::_Exit(3);
      case How::memory:
        memory.reset(new char[400'000'000]);
        for (volatile char* at = memory.get(); at < memory.get() + 400'000'000; at += 1024) *at = 1;
        [[fallthrough]];
      case How::endless:
        while (true) std::this_thread::sleep_for(seconds(1));
      case How::not_at_all:
        break;
    }
    return cloud;
  }
};

}  // namespace
VELUM_STAGE(Crash)
