// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <thread>

#include "run/linked.hpp"
#include "run_support.hpp"

namespace fs = std::filesystem;
using namespace velum;
using test::Folder;
using test::replaced;
using test::run_text;

namespace {

const std::string kChain = R"(
[node.start]
use = "test.numbers"
count = 1000
[node.a]
use = "test.move"
in = "start"
by = "1 spacing"
talk = true
[node.b]
use = "test.move"
in = "a"
[node.file]
use = "test.write"
in = "b"
file = "n.txt"
)";

run::RunOptions cached_options(const Folder& folder) {
  run::RunOptions options = test::options_for(folder);
  options.cache = folder / "cache";
  return options;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  return files;
}

void damage(const fs::path& file) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(static_cast<std::streamoff>(fs::file_size(file) / 2));
  stream.put('#');
  stream.put('~');
}

}  // namespace

TEST_CASE("a second run takes from the cache; writers run again", "[cache]") {
  const Folder folder;
  const auto options = cached_options(folder);
  const auto first = run_text(folder, kChain, options);
  CHECK(test::statuses(first) == "start=ok a=ok b=ok file=ok");
  fs::remove(folder / "out/n.txt");
  const auto second = run_text(folder, kChain, options);
  CHECK(test::statuses(second) == "start=cached a=cached b=cached file=ok");
  CHECK(folder.read("out/n.txt") == "1000\n");
  const auto& a = test::node_of(second, "a");
  CHECK(a.out == test::node_of(first, "a").out);
  CHECK(a.parameters == test::node_of(first, "a").parameters);
  CHECK(a.parameters.at("by").is_number());
  CHECK(a.measures.at("by").better == Better::lower);
  CHECK(a.warnings == std::vector<std::string>{"moved"});
  CHECK_FALSE(a.cpu_seconds);
}

TEST_CASE("only what follows a change runs again", "[cache]") {
  const Folder folder;
  const auto options = cached_options(folder);
  run_text(folder, kChain, options);
  const auto changed =
      run_text(folder, replaced(kChain, "in = \"a\"", "in = \"a\"\nby = 0.5"), options);
  CHECK(test::statuses(changed) == "start=cached a=cached b=ok file=ok");
  auto seeded = options;
  seeded.seed = 2;
  CHECK(test::statuses(run_text(folder, kChain, seeded)) == "start=ok a=ok b=ok file=ok");
  auto threads = options;
  threads.threads = 1;
  CHECK(test::statuses(run_text(folder, kChain, threads)) ==
        "start=cached a=cached b=cached file=ok");
}

TEST_CASE("the name of a node counts for seeded stages only", "[cache]") {
  const Folder folder;
  const auto options = cached_options(folder);
  const std::string text = test::kStart + R"(
[node.a]
use = "test.move"
in = "start"
)";
  run_text(folder, text, options);
  CHECK(test::statuses(run_text(folder, replaced(text, "node.a", "node.z"), options)) ==
        "start=cached z=cached");
}

TEST_CASE("what must not come from the cache does not", "[cache]") {
  const Folder folder;
  const auto options = cached_options(folder);
  const std::string text = R"(
[node.dice]
use = "test.dice"
[node.start]
use = "test.numbers"
cache = false
[node.a]
use = "test.move"
in = "start"
)";
  run_text(folder, text, options);
  const auto second = run_text(folder, text, options);
  CHECK(test::node_of(second, "dice").status == run::Status::ok);
  CHECK(test::node_of(second, "start").status == run::Status::ok);
  // Keyed by the content of its input, not by how that came about.
  CHECK(test::node_of(second, "a").status == run::Status::cached);
}

TEST_CASE("input files count by content and name, not by place", "[cache]") {
  const Folder folder;
  const auto options = cached_options(folder);
  folder.write("n.txt", "7");
  folder.write("elsewhere/n.txt", "7");
  const std::string text = "[node.in]\nuse = \"test.read\"\nfile = \"n.txt\"\n";
  CHECK(test::statuses(run_text(folder, text, options)) == "in=ok");
  CHECK(test::statuses(run_text(folder, replaced(text, "\"n.txt", "\"elsewhere/n.txt"), options)) ==
        "in=cached");
  folder.write("n.txt", "8");
  const auto changed = run_text(folder, text, options);
  CHECK(test::statuses(changed) == "in=ok");
  CHECK(changed.inputs.size() == 1);
}

TEST_CASE("a damaged result is computed again", "[cache]") {
  const Folder folder;
  const auto options = cached_options(folder);
  const auto first = run_text(folder, kChain, options);
  for (const fs::path& file : files_in(folder / "cache")) {
    INFO(file.string());
    damage(file);
    const auto again = run_text(folder, kChain, options);
    CHECK(again.status == run::Status::ok);
    CHECK(test::hash_of_node(again, "b") == test::hash_of_node(first, "b"));
    CHECK(folder.read("out/n.txt") == "1000\n");
  }
  for (const fs::path& file : files_in(folder / "cache")) damage(file);
  CHECK(test::statuses(run_text(folder, kChain, options)) == "start=ok a=ok b=ok file=ok");
  for (const fs::path& file : files_in(folder / "cache")) fs::resize_file(file, 10);
  CHECK(test::statuses(run_text(folder, kChain, options)) == "start=ok a=ok b=ok file=ok");
}

TEST_CASE("a missing value behind cached nodes is made from what it needs", "[cache]") {
  const Folder folder;
  const auto options = cached_options(folder);
  run_text(folder, kChain, options);
  fs::remove_all(folder / "cache/values");
  CHECK(test::statuses(run_text(folder, kChain, options)) == "start=ok a=ok b=ok file=ok");
}

TEST_CASE("the cache stays within its size", "[cache]") {
  const Folder folder;
  auto options = cached_options(folder);
  options.cache_limit = 100'000;
  for (int count = 1000; count < 1010; ++count)
    run_text(folder, replaced(kChain, "1000", std::to_string(count)), options);
  std::uintmax_t total = 0;
  for (const fs::path& file : files_in(folder / "cache")) total += fs::file_size(file);
  CHECK(total <= options.cache_limit);
  CHECK(total > 20'000);
  // What was used last is still there.
  CHECK(test::statuses(run_text(folder, replaced(kChain, "1000", "1009"), options))
            .starts_with("start=cached"));
}

TEST_CASE("a cache that cannot be written costs time only", "[cache]") {
  const Folder folder;
  auto options = test::options_for(folder);
  options.cache = folder.write("file", "no folder") / "cache";
  const auto record = run_text(folder, kChain, options);
  CHECK(record.status == run::Status::ok);
}

TEST_CASE("runs share a cache at once", "[cache]") {
  const Folder folder;
  std::vector<std::thread> threads;
  std::vector<std::string> hashes(6);
  for (std::size_t i = 0; i < hashes.size(); ++i)
    threads.emplace_back([&, i] {
      auto options = cached_options(folder);
      options.out = folder / ("out" + std::to_string(i));
      options.cache_limit = i % 2 == 0 ? 1'000 : 1'000'000;  // some throw away what others read
      for (int repeat = 0; repeat < 5; ++repeat) {
        run::Observer nobody;
        const auto graph = test::load(folder, kChain);
        hashes[i] = test::hash_of_node(
            run::run_graph(graph, test::registry(), options, nobody).record, "b");
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::string& hash : hashes) CHECK(hash == hashes.front());
}

TEST_CASE("libraries that a plugin links are known", "[cache]") {
  const auto file = test::registry().file("test.move");
  static_cast<void>(test::registry().stage("test.move"));
  const std::string libraries = run::linked_libraries(file);
  CHECK(libraries.find("libvelum.so") != std::string::npos);
  CHECK(libraries.find("libc.so") != std::string::npos);
  CHECK(run::kernel_hash().size() == 32);
}
