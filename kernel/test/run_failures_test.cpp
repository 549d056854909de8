// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "run_support.hpp"

namespace fs = std::filesystem;
using namespace velum;
using test::Folder;
using test::kStart;
using test::run_text;

TEST_CASE("what a stage throws names node and stage", "[failures]") {
  const std::vector<std::pair<std::string, std::string>> kinds = {
      {"error", "three points are too few"},
      {"input", "found 3 columns"},
      {"device", "no answer"},
      {"standard", "matrix is singular"},
      {"own", "not a std::exception"},
      {"integer", "not a std::exception"},
      {"memory", "out of memory"}};
  for (const auto& [what, message] : kinds) {
    const Folder folder;
    const auto record = run_text(folder, kStart + R"(
[node.bad]
use = "test.throws"
in = "start"
what = ")" + what + "\"\n");
    INFO(what);
    REQUIRE(record.failure);
    CHECK(record.status == run::Status::failed);
    CHECK(record.failure->node == "bad");
    CHECK(record.failure->stage == "test.throws");
    CHECK(record.failure->message.find(message) != std::string::npos);
    const int status = what == "input" ? 5 : what == "device" ? 7 : 1;
    CHECK(run::exit_status(record) == status);
    CHECK(run::format(*record.failure).find("'bad' (test.throws)") != std::string::npos);
  }
}

TEST_CASE("a failure skips what depends on it, and nothing else", "[failures]") {
  const Folder folder;
  const auto record = run_text(folder, kStart + R"(
[node.bad]
use = "test.throws"
in = "start"
[node.after]
use = "test.move"
in = "bad"
[node.later]
use = "test.write"
in = "after"
file = "later.txt"
[node.other]
use = "test.move"
in = "start"
[node.kept]
use = "test.write"
in = "other"
file = "kept.txt"
)");
  const std::string text = test::statuses(record);
  for (const std::string word :
       {"start=ok", "bad=failed", "after=skipped", "later=skipped", "other=ok", "kept=ok"})
    CHECK(text.find(word) != std::string::npos);
  CHECK(folder.read("out/kept.txt") == "100\n");
  CHECK_FALSE(fs::exists(folder / "out/later.txt"));
  CHECK(record.files.size() == 1);
}

TEST_CASE("an empty result is an error that tells who removed the points", "[failures]") {
  const Folder folder;
  const std::string graph = kStart + R"(
[node.low]
use = "test.drop"
in = "start"
above = "-1 m"
[node.moved]
use = "test.move"
in = "low"
)";
  const auto record = run_text(folder, graph);
  REQUIRE(record.failure);
  CHECK(record.failure->code == "E1002");
  CHECK(record.failure->node == "low");
  CHECK(record.failure->message.find("100 points") != std::string::npos);
  CHECK(run::exit_status(record) == 1);

  const auto later =
      run_text(folder, test::replaced(graph, "above =", "allow_empty = true\nabove ="));
  REQUIRE(later.failure);
  CHECK(later.failure->node == "moved");
  CHECK(later.failure->message.find("'low' (test.drop) was given 100 points") != std::string::npos);
}

TEST_CASE("what a stage gives beside its first output may be empty", "[failures]") {
  const Folder folder;
  const auto record = run_text(folder, kStart + R"(
[node.high]
use = "test.drop"
in = "start"
above = "1 km"
[node.none]
use = "test.move"
in = "high.dropped"
allow_empty = true
)");
  CHECK_FALSE(record.failure);
  CHECK(test::statuses(record).find("none=ok") != std::string::npos);
}

TEST_CASE("lengths relative to an input of no extent", "[failures]") {
  const Folder folder;
  const auto record = run_text(folder, kStart + R"(
[node.low]
use = "test.drop"
in = "start"
above = "-1 m"
allow_empty = true
[node.again]
use = "test.drop"
in = "low"
slack = "2 spacing"
allow_empty = true
)");
  CHECK_FALSE(record.failure);  // of nothing any length will do

  const auto alone = run_text(folder, kStart + R"(count = 1
[node.low]
use = "test.drop"
in = "start"
slack = "2 spacing"
)");
  REQUIRE(alone.failure);
  CHECK(alone.failure->code == "E1001");
  CHECK(run::exit_status(alone) == 1);
  CHECK(alone.failure->message.find("of 'cloud', which has none: it is one point") !=
        std::string::npos);
}

TEST_CASE("an output that was not made fails the node that needs it", "[failures]") {
  const Folder folder;
  const std::string text = kStart + R"(
[node.both]
use = "test.join"
in = ["start"]
count = COUNT
[node.rows]
use = "test.count"
in = "both.table"
)";
  const auto failed = run_text(folder, test::replaced(text, "COUNT", "false"));
  REQUIRE(failed.failure);
  CHECK(failed.failure->message.find("'both' made no 'table'") != std::string::npos);
  const auto made = run_text(folder, test::replaced(text, "COUNT", "true"));
  CHECK(made.status == run::Status::ok);
  CHECK(test::node_of(made, "rows").measures.at("rows").value == 1.0);
}

TEST_CASE("an interruption ends stages that listen", "[failures]") {
  const Folder folder;
  const auto began = std::chrono::steady_clock::now();
  const auto record = test::run_interrupted(folder, kStart + R"(
[node.slow]
use = "test.slow"
in = "start"
time = "30 s"
[node.after]
use = "test.move"
in = "slow"
)",
                                            std::chrono::milliseconds(200));
  CHECK(test::seconds_since(began) < 1.5);
  CHECK(record.status == run::Status::interrupted);
  CHECK(test::statuses(record) == "start=ok slow=interrupted after=skipped");
  CHECK(run::exit_status(record) == 130);
}
