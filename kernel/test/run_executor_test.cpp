// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>

#include "run_support.hpp"

using namespace velum;
using test::Folder;
using test::kStart;
using test::run_text;

namespace {

constexpr const char* kDiamond = R"(
[node.end]
use = "test.join"
in = ["left", "right"]
[node.left]
use = "test.move"
in = "start"
by = "1 spacing"
[node.right]
use = "test.move"
in = "start"
by = "0.25 m"
[node.start]
use = "test.numbers"
count = 500
)";

}  // namespace

TEST_CASE("every node runs once, whatever the order in the file", "[executor]") {
  const Folder folder;
  const auto record = run_text(folder, kDiamond);
  CHECK(record.status == run::Status::ok);
  CHECK(record.nodes.size() == 4);
  CHECK(record.nodes.front().name == "start");
  CHECK(test::node_of(record, "end").out.at("cloud").at("points") == 1000);
  CHECK(test::node_of(record, "end").out.at("table").is_null());
  CHECK(test::node_of(record, "end").in.at("clouds").size() == 2);
  CHECK(test::node_of(record, "end").in.at("clouds")[0].at("from") == "left.cloud");
  CHECK(run::exit_status(record) == 0);
}

TEST_CASE("results do not depend on the number of threads", "[executor]") {
  std::vector<std::string> hashes;
  for (const int threads : {1, 2, 4}) {
    const Folder folder;
    auto options = test::options_for(folder);
    options.threads = threads;
    hashes.push_back(test::hash_of_node(run_text(folder, kDiamond, options), "end"));
  }
  CHECK(hashes[0] == hashes[1]);
  CHECK(hashes[0] == hashes[2]);
}

TEST_CASE("ready nodes run at the same time", "[executor]") {
  const Folder folder;
  const std::string text = kStart + R"(
[node.a]
use = "test.slow"
in = "start"
time = "0.3 s"
[node.b]
use = "test.slow"
in = "start"
time = "0.3 s"
)";
  const auto began = std::chrono::steady_clock::now();
  const auto record = run_text(folder, text);
  CHECK(test::seconds_since(began) < 0.55);
  // What overlapped cannot be told apart; what ran alone can.
  CHECK_FALSE(test::node_of(record, "a").cpu_seconds);
  CHECK_FALSE(test::node_of(record, "b").peak_bytes);
  CHECK(test::node_of(record, "start").cpu_seconds);
  CHECK(test::node_of(record, "a").seconds >= 0.3);
}

TEST_CASE("relative lengths are resolved and recorded", "[executor]") {
  const Folder folder;
  const auto record = run_text(folder, kDiamond);
  const double by = test::node_of(record, "left").parameters.at("by").get<double>();
  CHECK(by > 0.01);
  CHECK(by < 0.2);
  CHECK(test::node_of(record, "left").measures.at("by").value == by);
  CHECK(test::node_of(record, "right").parameters.at("by") == 0.25);
  CHECK(test::node_of(record, "right").parameters.at("talk") == false);

  const auto failed = run_text(folder, kStart + R"(
[node.far]
use = "test.move"
in = "start"
by = "2000 % diagonal"
)");
  CHECK(failed.status == run::Status::failed);
  CHECK(failed.failure->fault == Fault::graph);
  CHECK(failed.failure->node == "far");
}

TEST_CASE("inputs of one call have one origin", "[executor]") {
  const Folder folder;
  const auto record = run_text(folder, R"(
[node.a]
use = "test.numbers"
origin = 1000
[node.b]
use = "test.numbers"
origin = 2000
[node.both]
use = "test.join"
in = ["a", "b"]
)");
  CHECK(test::node_of(record, "both").warnings.empty());
  CHECK(test::node_of(record, "both").out.at("cloud").at("origin")[0] == 1000.0);
}

TEST_CASE("random streams follow seed, stage and node", "[executor]") {
  const std::string text = R"(
[node.a]
use = "test.numbers"
[node.b]
use = "test.numbers"
[node.c]
use = "test.numbers"
seed = 9
)";
  const Folder folder;
  auto options = test::options_for(folder);
  const auto one = run_text(folder, text, options);
  options.seed = 2;
  const auto two = run_text(folder, text, options);
  CHECK(test::hash_of_node(one, "a") != test::hash_of_node(one, "b"));
  CHECK(test::hash_of_node(one, "a") != test::hash_of_node(two, "a"));
  CHECK(test::hash_of_node(one, "c") == test::hash_of_node(two, "c"));
}

TEST_CASE("only a node and what it needs", "[executor]") {
  const Folder folder;
  auto options = test::options_for(folder);
  options.only = {"left"};
  const auto record = run_text(folder, kDiamond, options);
  CHECK(test::statuses(record) == "start=ok left=ok");
  options.only = {"nowhere"};
  CHECK_THROWS_AS(run_text(folder, kDiamond, options), Error);
}

TEST_CASE("what stages say reaches observer and record", "[executor]") {
  struct Listener : run::Observer {
    std::vector<std::string> heard;
    void node_started(const std::string& node, const std::string&) override {
      heard.push_back("+" + node);
    }
    void said(const std::string& node, run::LocalContext::Level level,
              const std::string& message) override {
      const bool warning = level == run::LocalContext::Level::warning;
      heard.push_back((warning ? "! " : "i ") + node + " " + message);
    }
    void node_ended(const run::NodeRecord& node) override { heard.push_back("-" + node.name); }
    void file_written(const run::FileRecord& file) override { heard.push_back("> " + file.path); }
  } listener;
  const Folder folder;
  const auto graph = test::load(folder, kStart + R"(
[node.a]
use = "test.move"
in = "start"
talk = true
[node.file]
use = "test.write"
in = "a"
file = "sub/n.txt"
)");
  const auto record =
      run::run_graph(graph, test::registry(), test::options_for(folder), listener).record;
  CHECK(listener.heard == std::vector<std::string>{"+start", "-start", "+a", "! a moved",
                                                   "i a by much", "-a", "+file", "> sub/n.txt",
                                                   "-file"});
  CHECK(test::node_of(record, "a").warnings == std::vector<std::string>{"moved"});
  CHECK(record.files.at(0).bytes == 4);
  CHECK(record.files.at(0).node == "file");
}

TEST_CASE("a node costs the kernel microseconds", "[executor]") {
  std::string text = "[node.n0]\nuse = \"test.numbers\"\ncount = 3\n";
  constexpr int kNodes = 300;
  for (int i = 1; i < kNodes; ++i)
    text += "[node.n" + std::to_string(i) + "]\nuse = \"test.move\"\nin = \"n" +
            std::to_string(i - 1) + "\"\n";
  const Folder folder;
  const auto graph = test::load(folder, text);
  run::Observer nobody;
  double best = 1.0;
  for (int repeat = 0; repeat < 5; ++repeat) {
    run::ExecuteOptions options;
    options.out = folder.path();
    options.threads = 2;
    run::Executor executor(graph, test::registry(), options, nobody);
    const double began = run::own_cpu_seconds();  // not the clock: the machine may be busy
    CHECK(executor.run() == run::Ended::done);
    best = std::min(best, (run::own_cpu_seconds() - began) / kNodes);
  }
  WARN("kernel overhead per node: " << best * 1e6 << " us");
#ifndef VELUM_SANITIZED
  CHECK(best < 50e-6);
#endif
}
