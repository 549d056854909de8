// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <numeric>
#include <string>
#include <thread>

#include "run/local_context.hpp"

using velum::Index;
using velum::run::LocalContext;

TEST_CASE("run_chunks runs every chunk once", "[context]") {
  for (const int threads : {1, 2, 4}) {
    LocalContext context(threads, 1);
    std::vector<int> hits(1000, 0);
    context.run_chunks(1000, [&](Index i) { ++hits[static_cast<std::size_t>(i)]; });
    CHECK(std::all_of(hits.begin(), hits.end(), [](int h) { return h == 1; }));
    context.run_chunks(0, [](Index) { FAIL("no chunk"); });
  }
}

TEST_CASE("sums do not depend on the number of threads", "[context]") {
  std::vector<double> sums;
  for (const int threads : {1, 2, 3}) {
    LocalContext context(threads, 1);
    sums.push_back(velum::parallel_reduce(
        context, 100'000, 64, 0.0,
        [](Index begin, Index end) {
          double sum = 0.0;
          for (Index i = begin; i < end; ++i) sum += 1.0 / static_cast<double>(i + 1);
          return sum;
        },
        [](double& total, double part) { total += part; }));
  }
  CHECK(sums[0] == sums[1]);
  CHECK(sums[0] == sums[2]);
}

TEST_CASE("the exception of the first chunk wins", "[context]") {
  for (const int threads : {1, 2, 4}) {
    LocalContext context(threads, 1);
    std::string message;
    try {
      context.run_chunks(500, [](Index i) {
        if (i >= 100) throw std::runtime_error(std::to_string(i));
      });
    } catch (const std::runtime_error& error) {
      message = error.what();
    }
    CHECK(message == "100");
  }
}

TEST_CASE("chunks may run chunks", "[context]") {
  LocalContext context(2, 1);
  std::atomic<int> count = 0;
  context.run_chunks(20, [&](Index) { context.run_chunks(50, [&](Index) { ++count; }); });
  CHECK(count == 1000);
}

TEST_CASE("interruption stops between chunks", "[context]") {
  std::atomic<bool> flag = false;
  LocalContext context({.threads = 2, .arena = 0, .seed = 1, .cancel = &flag, .log = {}});
  std::atomic<int> done = 0;
  CHECK_THROWS_AS(context.run_chunks(1'000'000,
                                     [&](Index) {
                                       if (++done == 100) flag = true;
                                     }),
                  velum::Cancelled);
  CHECK(done < 1000);
  CHECK(context.cancelled());
  LocalContext own(1, 1);
  own.cancel();
  CHECK_THROWS_AS(own.run_chunks(1, [](Index) {}), velum::Cancelled);
}

TEST_CASE("progress never goes back", "[context]") {
  LocalContext context(1, 1);
  context.progress(0.5);
  context.progress(0.25);
  CHECK(context.fraction() == 0.5);
  context.progress(7.0);
  CHECK(context.fraction() == 1.0);
}

TEST_CASE("what a stage says is collected and passed on", "[context]") {
  std::vector<std::string> heard;
  LocalContext context({.threads = 1,
                        .arena = 0,
                        .seed = 1,
                        .cancel = nullptr,
                        .log = [&](LocalContext::Level level, const std::string& text) {
                          heard.push_back((level == LocalContext::Level::info ? "i " : "w ") +
                                          text);
                        }});
  context.warn("thin");
  context.info("step");
  context.measure("rms", 0.5, "m", velum::Better::lower);
  context.measure("rms", 0.25, "m", velum::Better::lower);
  CHECK(heard == std::vector<std::string>{"w thin", "i step"});
  CHECK(context.warnings() == std::vector<std::string>{"thin"});
  CHECK(context.measures().at("rms").value == 0.25);
  CHECK(context.measures().at("rms").better == velum::Better::lower);
}

TEST_CASE("seeds differ by run, stage and node", "[context]") {
  using velum::run::node_seed;
  CHECK(node_seed(1, "a.b", "n") == node_seed(1, "a.b", "n"));
  CHECK(node_seed(1, "a.b", "n") != node_seed(2, "a.b", "n"));
  CHECK(node_seed(1, "a.b", "n") != node_seed(1, "a.c", "n"));
  CHECK(node_seed(1, "a.b", "n") != node_seed(1, "a.b", "m"));
}
