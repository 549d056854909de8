// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "graph/toml.hpp"

namespace fs = std::filesystem;
namespace toml = velum::graph::toml;
using nlohmann::json;

namespace {

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string number_text(double x) {
  if (x != x) return "nan";
  return fmt::format("{}", x);
}

// As the suite writes what it expects.
json tagged(const toml::Node& node) {
  const auto leaf = [](const char* type, const std::string& value) {
    return json{{"type", type}, {"value", value}};
  };
  switch (node.kind) {
    case toml::Kind::table: {
      json table = json::object();
      for (const auto& entry : node.entries) table[entry.key] = tagged(entry.value);
      return table;
    }
    case toml::Kind::array: {
      json array = json::array();
      for (const auto& item : node.items) array.push_back(tagged(item));
      return array;
    }
    case toml::Kind::string:
      return leaf("string", node.text);
    case toml::Kind::integer:
      return leaf("integer", fmt::format("{}", node.integer));
    case toml::Kind::number:
      return leaf("float", number_text(node.number));
    case toml::Kind::boolean:
      return leaf("bool", node.boolean ? "true" : "false");
    case toml::Kind::offset_date_time:
      return leaf("datetime", node.text);
    case toml::Kind::local_date_time:
      return leaf("datetime-local", node.text);
    case toml::Kind::local_date:
      return leaf("date-local", node.text);
    case toml::Kind::local_time:
      return leaf("time-local", node.text);
  }
  return {};
}

// The suite's spellings of numbers and times in ours: "1e06" and "1000000", ".600" and ".6".
std::string normal(const std::string& type, std::string value) {
  if (type == "float" && value.find("nan") != std::string::npos) return "nan";
  if (type == "float") return number_text(std::stod(value));
  const auto dot = value.find('.');
  if (type == "string" || type == "integer" || type == "bool" || dot == std::string::npos)
    return value;
  auto end = value.find_first_not_of("0123456789", dot + 1);
  if (end == std::string::npos) end = value.size();
  auto last = value.find_last_not_of('0', end - 1);
  if (last == dot) --last;
  return value.substr(0, last + 1) + value.substr(end);
}

json normal(const json& expected) {
  if (expected.is_array()) {
    json array = json::array();
    for (const auto& item : expected) array.push_back(normal(item));
    return array;
  }
  const bool leaf = expected.size() == 2 && expected.contains("type") &&
                    expected.contains("value") && expected["type"].is_string();
  json table = json::object();
  for (const auto& [key, value] : expected.items()) table[key] = leaf ? value : normal(value);
  if (leaf) table["value"] = normal(expected["type"], expected["value"]);
  return table;
}

std::optional<fs::path> suite() {
  const char* shared = std::getenv("VELUM_SHARED");
  if (shared == nullptr) return std::nullopt;
  const fs::path folder = fs::path(shared) / "data/toml/toml-test/tests";
  if (!fs::exists(folder / "files-toml-1.0.0")) return std::nullopt;
  return folder;
}

}  // namespace

TEST_CASE("the suite toml-test for TOML 1.0.0") {
  const auto folder = suite();
  if (!folder) {
    WARN("skipped: toml-test is not there");
    return;
  }
  std::ifstream list(*folder / "files-toml-1.0.0");
  int valid = 0;
  int invalid = 0;
  for (std::string name; std::getline(list, name);) {
    if (!name.ends_with(".toml")) continue;
    INFO(name);
    const std::string text = read(*folder / name);
    if (name.starts_with("invalid/")) {
      ++invalid;
      CHECK_THROWS_AS(toml::parse(text), toml::SyntaxError);
      continue;
    }
    ++valid;
    const fs::path expected = (*folder / name).replace_extension(".json");
    try {
      CHECK(tagged(toml::parse(text)) == normal(json::parse(read(expected))));
    } catch (const toml::SyntaxError& error) {
      FAIL_CHECK(error.where().begin.line << ":" << error.where().begin.column << " "
                                          << error.what());
    }
  }
  CHECK(valid > 100);
  CHECK(invalid > 300);
}

namespace {

/// "2:5 message | hint" of what is refused; "" when it is not.
std::string refusal(const std::string& text) {
  try {
    (void)toml::parse(text);
  } catch (const toml::SyntaxError& error) {
    return fmt::format("{}:{} {}{}{}", error.where().begin.line, error.where().begin.column,
                       error.what(), error.hint().empty() ? "" : " | ", error.hint());
  }
  return "";
}

std::string times(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

}  // namespace

TEST_CASE("keys keep the order of the file, and everything has its place") {
  const toml::Node root =
      toml::parse("z = 1\na = [\n  \"x\", 2.5 ]\n[node.\"b c\"]\nin = {y = 1}\n");
  REQUIRE(root.entries.size() == 3);
  CHECK(root.entries[0].key == "z");
  CHECK(root.entries[1].key == "a");
  const auto& array = root.entries[1].value;
  CHECK(array.where.begin == toml::Position{2, 5});
  CHECK(array.items[0].where.begin == toml::Position{3, 3});
  CHECK(array.items[0].where.end == toml::Position{3, 6});
  CHECK(array.items[1].where.begin == toml::Position{3, 8});
  CHECK(array.items[1].where.end == toml::Position{3, 11});
  const auto* node = root.find("node");
  REQUIRE(node != nullptr);
  const auto& named = node->value.entries.at(0);
  CHECK(named.key == "b c");
  CHECK(named.where.begin == toml::Position{4, 7});
  CHECK(named.value.entries.at(0).value.entries.at(0).where.begin == toml::Position{5, 7});
  CHECK(root.find("none") == nullptr);
}

TEST_CASE("columns count characters, and a byte order mark is none") {
  const toml::Node root = toml::parse(
      "\xEF\xBB\xBF"
      "a = ['\u00e9\u20ac', 1]");
  CHECK(root.entries.at(0).where.begin == toml::Position{1, 1});
  CHECK(root.entries.at(0).value.items.at(1).where.begin == toml::Position{1, 12});
}

TEST_CASE("slips in values are told with what to write, at the value") {
  const std::string quotes = " is text without quotes | text needs quotes: ";
  CHECK(refusal("size = 5 mm") == "1:8 '5 mm'" + quotes + "\"5 mm\"");
  CHECK(refusal("a = 1\nsize = -2.5mm # c") == "2:8 '-2.5mm'" + quotes + "\"-2.5mm\"");
  CHECK(refusal("share = 10 %") == "1:9 '10 %'" + quotes + "\"10 %\"");
  CHECK(refusal("use = io.read_cloud\r\n") == "1:7 'io.read_cloud'" + quotes + "\"io.read_cloud\"");
  CHECK(refusal("size = mm") == "1:8 'mm'" + quotes + "\"mm\"");
  CHECK(refusal("a = [\"\u00e9\", mm]") == "1:11 'mm'" + quotes + "\"mm\"");
  CHECK(refusal("a = { b = 1, size = 5 mm }") == "1:21 '5 mm'" + quotes + "\"5 mm\"");
  CHECK(refusal("a = True") == "1:5 'True' is no value | write true, or \"...\" for text");
  CHECK(refusal("a = off") == "1:5 'off' is no value | write false, or \"...\" for text");
  CHECK(refusal("max_edge = 1e400") ==
        "1:12 1e400 is beyond what a number can be | numbers go to 1.7e308, and down to 5e-324");
  CHECK(refusal("seed = 18446744073709551615\n") ==
        "1:8 18446744073709551615 is beyond what a whole number can be | whole numbers go to "
        "9223372036854775807");
  CHECK(refusal("a = .5").starts_with("1:5 '.5' is no number of TOML"));
  CHECK(refusal("a = 1,5").starts_with("1:5 a comma after 1 | numbers have a point"));
}

TEST_CASE("other mistakes keep the parser's place and words") {
  CHECK(refusal("a = 2023-13-45").find("quotes") == std::string::npos);
  CHECK(refusal("a = 0xZZ").find("quotes") == std::string::npos);
  CHECK(refusal("a = mm\nb = 1").starts_with("1:5"));
  CHECK(refusal("mm = 1\nmm = 2").find("quotes") == std::string::npos);
  CHECK(refusal("[mm]\n[mm]").find("quotes") == std::string::npos);
  CHECK(refusal("a = \"\"\"\nb = mm \\q\n\"\"\"").find("quotes") == std::string::npos);
}

TEST_CASE("what toml++ 3.3.0 does not survive is refused before it") {
  CHECK(refusal("[\n[") == "1:2 a key is missing here");
  CHECK(refusal("[") == "1:2 a key is missing here");
  CHECK(refusal("[a.\n") == "1:4 a key is missing here");
  CHECK(refusal(std::string("1=[[[}}}}]\0", 11)).starts_with("1:5 this array is not closed"));
  CHECK(refusal("\u02b4 = 1").starts_with("1:1 character U+02B4 outside of a string"));
  CHECK(refusal("a = \u02b4").starts_with("1:5 character U+02B4 outside of a string"));
  CHECK(refusal("a = \"\xFF\"").starts_with("1:6 byte 0xFF is not UTF-8"));
  CHECK(refusal("a = \"\xED\xA0\x80\"").starts_with("1:6 byte 0xED is not UTF-8"));
  CHECK(refusal("a = \"\xC0\xAF\"").starts_with("1:6 byte 0xC0 is not UTF-8"));
  CHECK(refusal("a = 1\rb = 2").starts_with("1:6 control character U+000D"));
  CHECK(refusal("# \x07").starts_with("1:3 control character U+0007"));
}

TEST_CASE("what is not closed is reported where it opens") {
  CHECK(refusal("a = [1,\n 2\nb = 3\n") ==
        "1:5 this array is not closed | a ']' is missing before "
        "line 3");
  CHECK(refusal("a = [1,\n 2\n") ==
        "1:5 this array is not closed | a ']' is missing before line 4");
  CHECK(refusal("a = { b = 1\n") ==
        "1:5 this inline table does not end on its line | a '}' is missing");
  CHECK(refusal("a = [{ b = 1 ]") ==
        "1:6 this inline table is not closed | a '}' is missing before "
        "line 1");
  CHECK(refusal("\n a = \"\"\"x\"\"\n") ==
        "2:6 this string is not closed | it ends in three quotes");
  CHECK(refusal("a = 'x\n") == "1:5 this string is not closed | it ends on its line");
  CHECK(refusal("a = 1]") == "1:6 ']' closes nothing");
  CHECK(refusal("[a\n") == "1:1 this table header is not closed | it ends in ']' on the same line");
}

TEST_CASE("size and depth have limits") {
  CHECK(refusal(std::string((1U << 20U) + 1, ' ')) ==
        "1:1 1048577 bytes, more than the 1048576 that a graph may have");
  CHECK(refusal(std::string(1U << 20U, ' ')).empty());
  CHECK(refusal("a = " + times("[", 50) + times("]", 50)).empty());
  const std::string deep = "more than 64 levels within each other";
  CHECK(refusal("a = " + times("[", 100'000)).find(deep) != std::string::npos);
  CHECK(refusal("a = " + times("{a=", 100'000)).find(deep) != std::string::npos);
  CHECK(refusal("a" + times(".a", 100'000) + " = 1").find(deep) != std::string::npos);
  CHECK(refusal("[a" + times(".a", 100'000) + "]").find(deep) != std::string::npos);
  CHECK(refusal("a = {b" + times(".b", 100'000) + " = 1}").find(deep) != std::string::npos);
  CHECK(refusal("[a" + times(".a", 60) + "]\nb" + times(".b", 60) + " = 1").find(deep) !=
        std::string::npos);
}

TEST_CASE("values of a command line") {
  CHECK(toml::parse_value("5").integer == 5);
  CHECK(toml::parse_value("[1, 2]").items.size() == 2);
  CHECK(toml::parse_value("\"5 mm\"").text == "5 mm");
  CHECK(toml::parse_value("5 mm").text == "5 mm");
  CHECK(toml::parse_value("largest").text == "largest");
  CHECK(toml::parse_value("").text.empty());
  CHECK(toml::parse_value("1\nb = 2").is(toml::Kind::string));
  CHECK(toml::parse_value("5 # five").integer == 5);
}

TEST_CASE("quoted text reads the same") {
  const std::string odd = "quo\"te \\ \n \t \x01 \x7f \u00e9";
  CHECK(toml::parse("a = " + toml::quoted(odd)).entries.at(0).value.text == odd);
}
