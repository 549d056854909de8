// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>

#include "run_support.hpp"

namespace fs = std::filesystem;
using namespace velum;
using test::Folder;
using test::run_text;

namespace {

std::string graph_of(const std::string& how, const std::string& more = "") {
  return test::kStart + R"(
[node.bad]
use = "test.crash"
in = "start"
isolate = true
how = ")" +
         how + "\"\n" + more + R"(
[node.other]
use = "test.move"
in = "start"
)";
}

run::Failure failure_of(const std::string& text) {
  const Folder folder;
  const auto record = run_text(folder, text);
  REQUIRE(record.failure);
  CHECK(record.failure->node == "bad");
  CHECK(record.failure->stage == "test.crash");
  CHECK(test::node_of(record, "other").status == run::Status::ok);
  CHECK_FALSE(fs::exists(folder / "out/.velum.scratch"));
  return *record.failure;
}

}  // namespace

TEST_CASE("an isolated stage gives what it gives in the process", "[isolate]") {
  const Folder folder;
  const auto record = run_text(folder, graph_of("not_at_all"));
  REQUIRE(record.status == run::Status::ok);
  const auto& node = test::node_of(record, "bad");
  CHECK(test::hash_of_node(record, "bad") == test::hash_of_node(record, "start"));
  CHECK(node.measures.at("depth").value == 7.0);
  CHECK(node.warnings == std::vector<std::string>{"mind the gap"});
  REQUIRE(node.peak_bytes);
  CHECK(*node.peak_bytes > 1'000'000);
  CHECK(node.cpu_seconds);
}

TEST_CASE("isolated random numbers and relative lengths are those of the process", "[isolate]") {
  const std::string text = R"(
[node.start]
use = "test.numbers"
ISOLATE
[node.a]
use = "test.move"
in = "start"
by = "1 spacing"
ISOLATE
)";
  std::string isolated = text;
  std::string plain = text;
  for (int node = 0; node < 2; ++node) {
    isolated = test::replaced(isolated, "ISOLATE", "isolate = true");
    plain = test::replaced(plain, "ISOLATE", "");
  }
  const Folder one;
  const Folder two;
  const auto a = run_text(one, isolated);
  const auto b = run_text(two, plain);
  CHECK(a.status == run::Status::ok);
  CHECK(test::hash_of_node(a, "a") == test::hash_of_node(b, "a"));
}

TEST_CASE("a crash names signal, last message and seed", "[isolate]") {
  const auto segv = failure_of(graph_of("segv"));
  CHECK(segv.code == "E1003");
  CHECK(segv.message.find("SIGSEGV") != std::string::npos);
  CHECK(segv.message.find("seed") != std::string::npos);
  CHECK(segv.message.find("mind the gap") != std::string::npos);
#ifndef VELUM_SANITIZED
  CHECK(failure_of(graph_of("abort")).message.find("SIGABRT") != std::string::npos);
#endif
  CHECK(failure_of(graph_of("leave")).message.find("status 3") != std::string::npos);
}

TEST_CASE("limits on time and memory hold", "[isolate]") {
  const auto began = std::chrono::steady_clock::now();
  const auto slow = failure_of(graph_of("endless", "limits = { time = \"0.5 s\" }\n"));
  CHECK(slow.code == "E1004");
  CHECK(test::seconds_since(began) < 3.0);
#ifndef VELUM_SANITIZED
  const auto big =
      failure_of(graph_of("memory", "limits = { memory = \"200 MB\", time = \"60 s\" }\n"));
  CHECK(big.code == "E1005");
#endif
}

TEST_CASE("errors come back from the child as they are", "[isolate]") {
  const Folder folder;
  const auto record = run_text(folder, test::kStart + R"(
[node.bad]
use = "test.throws"
in = "start"
what = "input"
isolate = true
)");
  REQUIRE(record.failure);
  CHECK(record.failure->fault == Fault::input);
  CHECK(record.failure->where == "scan.txt:12");
  CHECK(record.failure->message == "found 3 columns, expected 4");
}

TEST_CASE("an interruption ends an isolated stage in time", "[isolate]") {
  const Folder folder;
  const auto began = std::chrono::steady_clock::now();
  const auto record =
      test::run_interrupted(folder, graph_of("endless"), std::chrono::milliseconds(500));
  CHECK(test::seconds_since(began) < 2.0);
  CHECK(test::node_of(record, "bad").status == run::Status::interrupted);
}
