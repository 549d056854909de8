// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "graph/diagnostic.hpp"
#include "graph/place.hpp"
#include "graph/printable.hpp"

using namespace velum::graph;  // NOLINT
namespace fs = std::filesystem;

namespace {

std::string shown(const std::string& text, toml::Region where, const std::string& hint = "",
                  const std::string& known = "") {
  Diagnostics diagnostics;
  const Source source("g.toml", text);
  Reporter(diagnostics, source).error("E0203", where, "message", hint, known);
  return format(diagnostics);
}

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("a mistake is shown with its line and a caret") {
  CHECK(shown("[node.down]\n  sise = 50\n", {{2, 3}, {2, 7}}, "did you mean 'size'?",
              "known: size, min_points") ==
        "error[E0203] g.toml:2:3  message\n"
        "    2 |     sise = 50\n"
        "      |     ^^^^ did you mean 'size'?  (known: size, min_points)\n");
  CHECK(shown("a\r\nb\r\n", {{2, 1}, {2, 2}}) ==
        "error[E0203] g.toml:2:1  message\n    2 |   b\n      |   ^\n");
  CHECK(shown("", {}) == "error[E0203] g.toml  message\n");
  CHECK(shown("", {}, "do this") == "error[E0203] g.toml  message\n      = do this\n");
}

TEST_CASE("carets count characters, not bytes, and stay on the line") {
  CHECK(shown("t = \"é\" x\n", {{1, 9}, {1, 10}}) ==
        "error[E0203] g.toml:1:9  message\n    1 |   t = \"é\" x\n      |           ^\n");
  CHECK(shown("\ta = [\n1]\n", {{1, 6}, {2, 2}}) ==
        "error[E0203] g.toml:1:6  message\n    1 |    a = [\n      |        ^\n");
  CHECK(shown("abc\n", {{1, 9}, {1, 900}}) ==
        "error[E0203] g.toml:1:9  message\n    1 |   abc\n      |           ^\n");
}

TEST_CASE("what steers a terminal is escaped, letters stay, and the caret is right") {
  CHECK(shown("a\x1B[31m é\xFF b", {{1, 10}, {1, 11}}) ==
        "error[E0203] g.toml:1:10  message\n    1 |   a\\x1B[31m é\\xFF b\n      |   " +
            std::string(15, ' ') + "^\n");
  CHECK(shown("\u202Eb", {{1, 1}, {1, 2}}) ==
        "error[E0203] g.toml:1:1  message\n    1 |   \\u202Eb\n      |   ^^^^^^\n");
  CHECK(shown("\xC2\x9B"
              "2J",
              {{1, 2}, {1, 3}}) ==
        "error[E0203] g.toml:1:2  message\n    1 |   \\x9B2J\n      |       ^\n");
  CHECK(shown("x", {{1, 1}, {1, 2}}, "did you mean '\x07'?").find("'\\x07'?") != std::string::npos);
  // Overlong forms, surrogates and cut sequences are no UTF-8.
  CHECK(printable("\xC0\xAF \xED\xA0\x80 \xE2\x82") == "\\xC0\\xAF \\xED\\xA0\\x80 \\xE2\\x82");
  CHECK(printable("a\tb\nc \u00df \u4e2d") == "a b\nc \u00df \u4e2d");
}

TEST_CASE("a place without a line is the file") {
  Diagnostic diagnostic;
  diagnostic.file = "g.toml";
  CHECK(place_of(diagnostic) == "g.toml");
  diagnostic.where = {{3, 5}, {3, 6}};
  CHECK(place_of(diagnostic) == "g.toml:3:5");
}

TEST_CASE("long lines are cut around the place") {
  const std::string text = std::string(500, 'a') + "b" + std::string(500, 'c');
  CHECK(shown(text, {{1, 501}, {1, 502}}) == "error[E0203] g.toml:1:501  message\n    1 |   " +
                                                 std::string(25, 'a') + "b" + std::string(74, 'c') +
                                                 "\n      |   " + std::string(25, ' ') + "^\n");
}

TEST_CASE("suggestions") {
  const std::vector<std::string> known = {"size", "min_points", "mode", "k"};
  CHECK(did_you_mean("sise", known) == "did you mean 'size'?");
  CHECK(did_you_mean("szie", known) == "did you mean 'size'?");
  CHECK(did_you_mean("minpoints", known) == "did you mean 'min_points'?");
  CHECK(did_you_mean("colour", known).empty());
  CHECK(did_you_mean("q", known).empty());
  CHECK(did_you_mean("", known).empty());
  CHECK(did_you_mean(std::string(1000, 'x'), known).empty());
  CHECK(did_you_mean("sise", {}).empty());
  CHECK(known_list(known) == "known: size, min_points, mode, k");
  CHECK(known_list({}).empty());
  CHECK(known_list(std::vector<std::string>(100, "a")).ends_with("a, ..."));
}

TEST_CASE("exit status: plugins that do not load, unless there is another mistake") {
  Diagnostics diagnostics;
  CHECK(exit_status(diagnostics) == 0);
  const Source source("g.toml", "");
  const Reporter report(diagnostics, source);
  report.error("E0305", {}, "no").fault = velum::Fault::plugin;
  CHECK(exit_status(diagnostics) == 4);
  report.error("E0203", {}, "no");
  CHECK(exit_status(diagnostics) == 2);
  CHECK(format(diagnostics).ends_with("2 mistakes\n"));
}

TEST_CASE("every code is explained, and every explained code exists") {
  const fs::path root = VELUM_SOURCE_DIR;
  const std::regex quoted("\"(E0[0-9]{3})\"");
  std::set<std::string> used;
  for (const auto& file : fs::directory_iterator(root / "kernel/src/graph")) {
    if (file.path().extension() != ".cpp") continue;
    const std::string text = read(file.path());
    for (std::sregex_iterator it(text.begin(), text.end(), quoted), end; it != end; ++it)
      used.insert((*it)[1]);
  }
  const std::string docs = read(root / "docs/errors.md");
  const std::regex heading("(?:^|\n)### (E0[0-9]{3}) ");
  std::set<std::string> explained;
  for (std::sregex_iterator it(docs.begin(), docs.end(), heading), end; it != end; ++it)
    explained.insert((*it)[1]);
  CHECK(used.size() > 30);
  CHECK(used == explained);
}
