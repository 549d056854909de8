// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/table_io.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/out_fields.hpp"

namespace velum::formats {
namespace {

/// A cell of CSV after RFC 4180.
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string number(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::string csv_value(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return csv_cell(*text);
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return std::to_string(*whole);
  return number(std::get<double>(cell));
}

/// JSON knows no NaN and no infinity.
std::string json_value(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return json_text(*text);
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return std::to_string(*whole);
  const double value = std::get<double>(cell);
  return std::isfinite(value) ? number(value) : "null";
}

template <class List, class Item>
std::string joined(const List& list, const char* separator, const Item& item) {
  std::string text;
  for (const auto& one : list) {
    if (&one != &list.front()) text += separator;
    text += item(one);
  }
  return text;
}

}  // namespace

std::string table_as_csv(const Table& table) {
  std::string text = joined(table.headings(), ",", [](const Table::Heading& heading) {
    return csv_cell(heading.unit.empty() ? heading.name : heading.name + " [" + heading.unit + "]");
  });
  text += '\n';
  for (const auto& row : table.rows()) text += joined(row, ",", csv_value) + '\n';
  return text;
}

std::string table_as_json(const Table& table) {
  std::string text = "{\n  \"columns\": [";
  text += joined(table.headings(), ", ", [](const Table::Heading& heading) {
    return "{\"name\": " + json_text(heading.name) + ", \"unit\": " + json_text(heading.unit) + "}";
  });
  text += "],\n  \"rows\": [";
  text += joined(table.rows(), ",", [](const std::vector<Cell>& row) {
    return "\n    [" + joined(row, ", ", json_value) + "]";
  });
  return text + (table.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

void write_table(const std::filesystem::path& path, const Table& table, TableFormat format) {
  if (format == TableFormat::automatic)
    format = lower(path.extension().string()) == ".json" ? TableFormat::json : TableFormat::csv;
  write_file(path, format == TableFormat::json ? table_as_json(table) : table_as_csv(table));
}

}  // namespace velum::formats
