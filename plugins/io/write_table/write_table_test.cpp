// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "formats/test_faults.hpp"
#include "formats/test_stages.hpp"

using velum::Error;
using velum::Table;
using velum::formats::test::Folder;
using velum::formats::test::text_of;
using velum::test::Stage;

namespace {

Stage stage(const std::filesystem::path& file) {
  return velum::formats::test::stage_on("io.write_table", file);
}

Table sections(int rows) {
  Table table({{"height", ""}, {"chord", "m"}, {"note", ""}});
  for (int i = 0; i < rows; ++i)
    table.add({0.1 * i, std::int64_t{i}, std::string(i % 2 == 0 ? "even" : "odd, so")});
  return table;
}

}  // namespace

TEST_CASE("units stand in the header, cells with commas in quotes") {
  const Folder folder;
  const auto outcome = stage(folder / "a.csv").run(sections(2));
  CHECK(text_of(folder / "a.csv") == "height,chord [m],note\n0,0,even\n0.1,1,\"odd, so\"\n");
  CHECK(outcome.measure("rows") == 2.0);
}

TEST_CASE("numbers have as many digits as it takes") {
  const Folder folder;
  stage(folder / "a.csv").run(sections(4));
  CHECK_THAT(text_of(folder / "a.csv"), Catch::Contains("\n0.30000000000000004,3,"));
}

TEST_CASE("JSON by extension and by parameter") {
  const Folder folder;
  stage(folder / "a.json").run(sections(2));
  stage(folder / "a.dat").set("format", "json").run(sections(2));
  CHECK(text_of(folder / "a.json") == text_of(folder / "a.dat"));
  CHECK(text_of(folder / "a.json").front() == '{');
}

TEST_CASE("a table without rows has its header") {
  const Folder folder;
  stage(folder / "a.csv").run(sections(0));
  CHECK(text_of(folder / "a.csv") == "height,chord [m],note\n");
}

TEST_CASE("an earlier file is replaced, a folder is not") {
  const Folder folder;
  velum::write_file(folder / "a.csv", "earlier");
  stage(folder / "a.csv").run(sections(1));
  CHECK(text_of(folder / "a.csv") != "earlier");
  std::filesystem::create_directory(folder / "b.csv");
  CHECK_THROWS_AS(stage(folder / "b.csv").run(sections(1)), Error);
}

TEST_CASE("a full disk, a read-only folder and a kill leave no half file") {
  for (const std::string& fault : velum::formats::test::writer_faults(
           [](const auto& path) { stage(path).threads(1).run(sections(5000)); }))
    FAIL_CHECK(fault);
}

TEST_CASE("an interrupted run leaves nothing") {
  const Folder folder;
  CHECK_THROWS(stage(folder / "a.csv").cancelled().run(sections(1)));
  CHECK_FALSE(std::filesystem::exists(folder / "a.csv"));
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("io.write_table", {{"file", "a.csv"}}))
    FAIL_CHECK(fault);
}
