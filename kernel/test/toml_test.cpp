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
