// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <limits>

#include "run/compare.hpp"
#include "run/machine.hpp"
#include "run/output_folder.hpp"
#include "run/setting_json.hpp"
#include "run/summary.hpp"
#include "run/usage.hpp"
#include "run_support.hpp"

namespace fs = std::filesystem;
using namespace velum;
using run::Json;
using test::Folder;
using test::run_text;

namespace {

constexpr const char* kSmall = R"(
title = "small"
[node.start]
use = "test.numbers"
[node.file]
use = "test.write"
in = "start"
file = "sub/n.txt"
)";

std::string refusal(const fs::path& out, const std::string& graph) {
  try {
    const run::OutputFolder folder(out, graph, {});
  } catch (const Error& error) {
    CHECK(error.fault() == Fault::output);
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("the record has everything that is promised", "[record]") {
  const Folder folder;
  run_text(folder, kSmall);
  const Json record = Json::parse(folder.read("out/run.json"));
  for (const char* key : {"velum", "graph", "status", "started", "seconds", "cpu_seconds",
                          "peak_bytes", "threads", "seed", "machine", "nodes", "files", "inputs"})
    CHECK(record.contains(key));
  CHECK(record.at("error").is_null());
  CHECK(record.at("graph").at("title") == "small");
  CHECK(record.at("graph").at("path") == fs::canonical(folder.path()).string() + "/g.toml");
  CHECK(record.at("graph").at("hash").get<std::string>().size() == 32);
  CHECK(record.at("started").get<std::string>().size() == 20);
  const Json& node = record.at("nodes").at(0);
  for (const char* key :
       {"name", "use", "version", "plugin_hash", "status", "seconds", "cpu_seconds", "peak_bytes",
        "parameters", "in", "out", "measures", "warnings"})
    CHECK(node.contains(key));
  CHECK(node.at("out").at("cloud").at("type") == "cloud");
  CHECK(node.at("out").at("cloud").at("points") == 100);
  CHECK(node.at("out").at("cloud").at("hash").get<std::string>().size() == 32);
  CHECK(node.at("measures").at("count") ==
        Json{{"value", 100.0}, {"unit", ""}, {"better", "neither"}});
  CHECK(node.at("parameters").at("count") == 100);
  CHECK(record.at("files").at(0).at("path") == "sub/n.txt");
  CHECK(record.at("files").at(0).at("node") == "file");
  CHECK(record.at("nodes").at(1).at("parameters").at("file") == "sub/n.txt");
  CHECK(record.at("machine").at("instruction_set").get<std::string>() == run::instruction_set());
  CHECK(record.at("machine").at("memory_bytes") > 1000000);
}

TEST_CASE("a failed run has a record too", "[record]") {
  const Folder folder;
  folder.write("many.txt", "lots\n");
  run_text(folder, "[node.in]\nuse = \"test.read\"\nfile = \"many.txt\"\n");
  const Json record = Json::parse(folder.read("out/run.json"));
  CHECK(record.at("status") == "failed");
  CHECK(record.at("error").at("code") == "E1050");
  CHECK(record.at("error").at("node") == "in");
  CHECK(record.at("error").at("where").get<std::string>().find("many.txt:1") != std::string::npos);
  CHECK(record.at("inputs").at(0).at("bytes") == 5);
}

TEST_CASE("errors have the form of their kind", "[record]") {
  run::Failure failure{Fault::input, "E1050", "scan", "io.read", "found 3", "a.txt:7", "look"};
  CHECK(run::format(failure) ==
        "error[E1050] a.txt:7  found 3\n  read by node 'scan' (io.read)\n  look\n");
  failure.fault = Fault::output;
  CHECK(run::format(failure).find("written by node 'scan'") != std::string::npos);
  failure.fault = Fault::stage;
  CHECK(run::format(failure) ==
        "error[E1050] node 'scan' (io.read): found 3\n  at a.txt:7\n  look\n");
}

TEST_CASE("settings survive JSON", "[record]") {
  Parameter number;
  number.name = "x";
  Parameter length = number;
  length.type = ParameterType::length;
  Parameter place = number;
  place.type = ParameterType::point;
  Parameter words = number;
  words.type = ParameterType::text;
  words.list = true;
  Parameter pairs = number;
  pairs.type = ParameterType::rows;
  pairs.fields = {place, length};
  pairs.fields[1].name = "y";
  const Setting point{Setting::List{{1.0}, {0.1}, {-3e300}}};
  const auto survives = [](const Parameter& parameter, const Setting& setting) {
    return run::from_json(parameter, Json::parse(run::dump(run::to_json(parameter, setting)))) ==
           setting;
  };
  CHECK(survives(number, {0.1 + 0.2}));
  CHECK(survives(number, {std::numeric_limits<double>::infinity()}));
  CHECK(survives(number, {}));
  CHECK(survives(length, {Length(0.05)}));
  CHECK(survives(place, point));
  CHECK(survives(words, {Setting::List{{std::string("a")}, {std::string("b")}}}));
  CHECK(survives(pairs, {Setting::List{{Setting::List{point, {Length(2.0)}}}}}));
  CHECK(run::to_json(length, {spacings(2.0)}) == "2 spacing");
  CHECK(run::to_json(pairs, {Setting::List{{Setting::List{point, {Length(2.0)}}}}})[0].at("y") ==
        2.0);
  CHECK_THROWS_AS(run::from_json(place, Json("far")), Error);
}

TEST_CASE("summaries in words", "[record]") {
  CHECK(run::in_words({{"type", "cloud"}, {"points", 1234567}}) == "1,234,567 points");
  CHECK(run::in_words({{"type", "mesh"}, {"triangles", 1}, {"vertices", 3}}) ==
        "1 triangle, 3 vertices");
  CHECK(run::in_words({{"type", "transform"}}) == "transform");
  CHECK(run::amount(run::summarise(Value(Cloud(Points::Zero(3, 4).eval())))) == 4.0);
  CHECK(run::amount(run::summarise(Value(Transform{}))) == -1.0);
  CHECK(run::summarise(Value(Table({{"a", "m"}}))).at("columns") == Json::array({"a"}));
}

TEST_CASE("earlier files of the same graph are replaced", "[output]") {
  const Folder folder;
  run_text(folder, kSmall);
  std::string other = kSmall;
  other.replace(other.find("sub/n.txt"), 9, "m.txt");
  run_text(folder, other);
  CHECK(fs::exists(folder / "out/m.txt"));
  CHECK_FALSE(fs::exists(folder / "out/sub"));
  CHECK_FALSE(fs::exists(folder / "out/.velum.lock"));
}

TEST_CASE("a folder with anything else is refused, and left as it was", "[output]") {
  const Folder folder;
  run_text(folder, kSmall);
  folder.write("out/notes.txt", "mine");
  CHECK(refusal(folder / "out", run::graph_name(folder / "g.toml")).find("notes.txt") !=
        std::string::npos);
  CHECK(fs::exists(folder / "out/sub/n.txt"));
  CHECK_FALSE(fs::exists(folder / "out/.velum.lock"));
  fs::remove(folder / "out/notes.txt");
  CHECK(refusal(folder / "out", "/another/graph.toml").find("another graph") != std::string::npos);
  CHECK(refusal(folder / "out", run::graph_name(folder / "g.toml")).empty());

  folder.write("plain/file.txt", "mine");
  CHECK(refusal(folder / "plain", "g").find("file.txt") != std::string::npos);
  CHECK(refusal(folder / "plain/file.txt", "g").find("folder") != std::string::npos);
  folder.write("json/run.json", "{}");
  CHECK(refusal(folder / "json", "g").find("run.json") != std::string::npos);
}

TEST_CASE("records that name files elsewhere harm nobody", "[output]") {
  const Folder folder;
  folder.write("precious.txt", "mine");
  folder.write(
      "out/run.json",
      Json{{"graph", {{"path", "g"}}},
           {"files",
            {{{"path", "../precious.txt"}}, {{"path", (folder / "precious.txt").string()}}}}}
          .dump());
  CHECK(refusal(folder / "out", "g").empty());
  CHECK(folder.read("precious.txt") == "mine");
}

TEST_CASE("two runs do not write to one folder", "[output]") {
  const Folder folder;
  const run::OutputFolder first(folder / "out", "g", {"a.txt"});
  CHECK(refusal(folder / "out", "g").find("process " + std::to_string(::getpid())) !=
        std::string::npos);
}

TEST_CASE("what a killed run left is known", "[output]") {
  const Folder folder;
  folder.write("out/.velum.lock", "1\ng\nrun.json\na.txt\n");
  folder.write("out/a.txt", "half");
  folder.write("out/.b.txt.partial.99", "half");
  folder.write("out/.velum.scratch/node/call.json", "half");
  CHECK(refusal(folder / "out", "h").find("another graph") != std::string::npos);
  CHECK(refusal(folder / "out", "g").empty());
  CHECK_FALSE(fs::exists(folder / "out/a.txt"));
  CHECK_FALSE(fs::exists(folder / "out/.velum.scratch"));
}

TEST_CASE("comparing records", "[record]") {
  const Folder folder;
  run_text(folder, kSmall);
  const Json before = Json::parse(folder.read("out/run.json"));
  auto options = test::options_for(folder);
  run_text(folder, kSmall, options);
  CHECK(run::compare(before, Json::parse(folder.read("out/run.json"))).empty());
  options.seed = 5;
  run_text(folder, kSmall, options);
  const auto differences = run::compare(before, Json::parse(folder.read("out/run.json")));
  REQUIRE(differences.size() == 1);
  CHECK(differences[0].find("node 'start', output 'cloud': hash") == 0);
}

TEST_CASE("peak memory is told from a mark on", "[record]") {
  run::PeakMeter meter;
  const auto use = [](std::size_t megabytes) {
    std::vector<char> memory(megabytes << 20U, 1);
    return memory[megabytes];
  };
  CHECK(use(120) == 1);
  meter.mark();
  const auto before = meter.since_mark();
  if (before == 0) {
    WARN("skipped: this system does not tell the peak of memory since a mark");
    return;
  }
  CHECK(use(40) == 1);
#ifndef VELUM_SANITIZED
  CHECK(meter.since_mark() < before + (60U << 20U));
#endif
  CHECK(meter.since_mark() > before + (20U << 20U));
  CHECK(meter.whole() >= (120U << 20U));
}
