// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/table_io.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "formats/test_tools.hpp"

using namespace velum;
using namespace velum::formats;

namespace {

Table some_table() {
  Table table({{"height", ""}, {"chord", "m"}, {"name, or \"label\"", ""}});
  table.add({0.1, std::int64_t{-3}, std::string("plain")});
  table.add(
      {1.0 / 3.0, std::numeric_limits<double>::quiet_NaN(), std::string("two\nlines, \"so\"")});
  return table;
}

}  // namespace

TEST_CASE("a table as CSV") {
  CHECK(table_as_csv(some_table()) ==
        "height,chord [m],\"name, or \"\"label\"\"\"\n0.1,-3,plain\n"
        "0.3333333333333333,nan,\"two\nlines, \"\"so\"\"\"\n");
}

TEST_CASE("a table as JSON") {
  CHECK(
      table_as_json(some_table()) ==
      "{\n  \"columns\": [{\"name\": \"height\", \"unit\": \"\"}, {\"name\": \"chord\", \"unit\": "
      "\"m\"}, {\"name\": \"name, or \\\"label\\\"\", \"unit\": \"\"}],\n  \"rows\": [\n    [0.1, "
      "-3, "
      "\"plain\"],\n    [0.3333333333333333, null, \"two\\nlines, \\\"so\\\"\"]\n  ]\n}\n");
}

TEST_CASE("an empty table has its header") {
  const Table table(std::vector<Table::Heading>{{"a", "mm"}});
  CHECK(table_as_csv(table) == "a [mm]\n");
  CHECK(table_as_json(table) ==
        "{\n  \"columns\": [{\"name\": \"a\", \"unit\": \"mm\"}],\n  \"rows\": []\n}\n");
}

TEST_CASE("the extension chooses the format") {
  const test::Folder folder;
  write_table(folder / "a.json", some_table(), TableFormat::automatic);
  write_table(folder / "a.csv", some_table(), TableFormat::automatic);
  CHECK(FileContent(folder / "a.json").text() == table_as_json(some_table()));
  CHECK(FileContent(folder / "a.csv").text() == table_as_csv(some_table()));
}
