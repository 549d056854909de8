// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/journal.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "folder.hpp"
#include "run/output_folder.hpp"
#include "study/folder.hpp"

using namespace velum::study;  // NOLINT: a test
using TestFolder = velum::test::Folder;

namespace {

const Journal::Heading kHeading{"/g.toml", "k1"};

Outcome outcome(double value) {
  Outcome made;
  made.status = Status::ok;
  made.message = "two\nlines, and \xff";
  made.figures["a.b"] = {value, "m", velum::Better::higher};
  made.source = "s";
  return made;
}

}  // namespace

TEST_CASE("what was added is there again") {
  const TestFolder folder;
  Journal(folder / "j", kHeading).add({3, 1}, outcome(0.1));
  Journal journal(folder / "j", kHeading);
  journal.add({4, 0}, outcome(std::nan("")));
  const Journal again(folder / "j", kHeading);
  REQUIRE(again.outcomes().size() == 2);
  const Outcome& found = again.outcomes().at({3, 1});
  CHECK(found.figures.at("a.b").value == 0.1);
  CHECK(found.figures.at("a.b").better == velum::Better::higher);
  CHECK(std::isnan(again.outcomes().at({4, 0}).figures.at("a.b").value));
  CHECK(Journal::heading_of(folder / "j")->key == "k1");
}

TEST_CASE("cut off anywhere it keeps every whole line and goes on") {
  const TestFolder folder;
  {
    Journal journal(folder / "j", kHeading);
    for (std::size_t v = 0; v < 3; ++v) journal.add({v, 0}, outcome(1.0));
  }
  const std::string whole = folder.read("j");
  for (std::size_t length = 0; length <= whole.size(); length += 7) {
    folder.write("j", whole.substr(0, length));
    {
      Journal journal(folder / "j", kHeading);
      const auto lines = std::count(whole.begin(), whole.begin() + static_cast<long>(length), '\n');
      CHECK(journal.outcomes().size() == static_cast<std::size_t>(std::max<long>(lines - 1, 0)));
      journal.add({9, 9}, outcome(2.0));
    }
    CHECK(Journal(folder / "j", kHeading).outcomes().contains({9, 9}));
  }
}

TEST_CASE("a damaged line costs its own cell only") {
  const TestFolder folder;
  {
    Journal journal(folder / "j", kHeading);
    for (std::size_t v = 0; v < 3; ++v) journal.add({v, 0}, outcome(1.0));
  }
  std::string text = folder.read("j");
  text[text.find("[1,0]") + 1] = '7';
  folder.write("j", text);
  const Journal journal(folder / "j", kHeading);
  CHECK(journal.outcomes().size() == 2);
  CHECK_FALSE(journal.outcomes().contains({1, 0}));
}

TEST_CASE("a journal that another process writes is read line by line") {
  const TestFolder folder;
  std::vector<std::size_t> seen;
  const auto read = [&](std::size_t from) {
    return Journal::read(folder / "j", from,
                         [&](const Cell& cell, const Outcome&) { seen.push_back(cell.variant); });
  };
  CHECK(read(0) == 0);  // not there yet
  std::string whole;
  {
    Journal journal(folder / "other", kHeading);
    for (std::size_t v = 0; v < 3; ++v) journal.add({v, 0}, outcome(1.0));
  }
  whole = folder.read("other");
  std::size_t at = 0;
  for (std::size_t length = 0; length < whole.size(); length += 50) {
    folder.write("j", whole.substr(0, length));
    at = read(at);
  }
  folder.write("j", whole);
  CHECK(read(at) == whole.size());
  CHECK(seen == std::vector<std::size_t>{0, 1, 2});
}

TEST_CASE("a journal without its heading is not thrown away") {
  const TestFolder folder;
  {
    const Folder held(folder / "out", kHeading, false);
    Journal journal(folder / "out/study.journal", kHeading);
    for (std::size_t v = 0; v < 3; ++v) journal.add({v, 0}, outcome(1.0));
  }
  std::string text = folder.read("out/study.journal");
  text[0] = text[0] == '0' ? '1' : '0';
  folder.write("out/study.journal", text);
  for (const bool resume : {true, false})
    CHECK_THROWS_WITH(Folder(folder / "out", kHeading, resume),
                      "the heading is damaged; the outcomes of 3 cells are there");
  CHECK(folder.read("out/study.journal") == text);
}

TEST_CASE("a run and a study of one graph share a folder") {
  const TestFolder folder;
  folder.write("out/run.json",
               R"({"graph": {"path": "/g.toml"}, "files": [{"path": "parts/a.ply"}]})");
  folder.write("out/parts/a.ply", "of the run");
  { const Folder held(folder / "out", kHeading, false); }
  CHECK(folder.read("out/parts/a.ply") == "of the run");
  Journal(folder / "out/study.journal", kHeading).add({0, 0}, outcome(1.0));
  CHECK(names_of_study(folder / "out", "/other.toml").empty());
  {
    const velum::run::OutputFolder held(folder / "out", "/g.toml", {},
                                        names_of_study(folder / "out", "/g.toml"));
    CHECK_THROWS_WITH(Folder(folder / "out", kHeading, true),
                      "another process is writing to this folder");
  }
  CHECK_FALSE(std::filesystem::exists(folder / "out/parts/a.ply"));
  CHECK(Journal(folder / "out/study.journal", kHeading).outcomes().size() == 1);
  folder.write("out/run.json", R"({"graph": {"path": "/h.toml"}, "files": []})");
  CHECK_THROWS_WITH(Folder(folder / "out", kHeading, true),
                    "the folder holds the results of another graph, /h.toml");
}

TEST_CASE("a study's folder is its own") {
  const TestFolder folder;
  {
    const Folder held(folder / "out", kHeading, false);
    CHECK_THROWS_WITH(Folder(folder / "out", kHeading, false),
                      "another process is writing to this folder");
    Journal(folder / "out/study.journal", kHeading).add({0, 0}, outcome(1.0));
  }
  CHECK_NOTHROW(Folder(folder / "out", kHeading, true));
  CHECK_THROWS_WITH(Folder(folder / "out", {"/g.toml", "k2"}, true),
                    "the graph, its study or a plugin has changed since");
  CHECK_THROWS_WITH(Folder(folder / "out", {"/other.toml", "k1"}, false),
                    "the folder holds the study of another graph, /g.toml");
  folder.write("out/mine.txt", "");
  CHECK_THROWS_WITH(Folder(folder / "out", kHeading, false),
                    "the folder holds what is not a result of a study: mine.txt");
  std::filesystem::remove(folder / "out/mine.txt");
  { const Folder anew(folder / "out", kHeading, false); }
  CHECK_FALSE(std::filesystem::exists(folder / "out/study.journal"));
}
