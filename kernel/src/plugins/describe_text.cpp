// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "graph/settings.hpp"
#include "plugins/describe.hpp"
#include "velum/files.hpp"

namespace velum::plugins {
namespace {

constexpr std::size_t kWidth = 100;

/// Words in lines of kWidth characters that begin with `indent` blanks.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::string lines;
  std::size_t column = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    begin = end + 1;
    if (word.empty()) continue;
    if (column > 0 && column + 1 + word.size() <= kWidth) {
      lines += " " + word;
      column += 1 + word.size();
    } else {
      lines += (lines.empty() ? "" : "\n") + std::string(indent, ' ') + word;
      column = indent + word.size();
    }
  }
  return lines.empty() ? "" : lines + "\n";
}

std::string types_of(const Port& port) {
  std::string text;
  for (const ValueType type : port.types)
    text += (text.empty() ? "" : " or ") + std::string(name_of(type));
  return text;
}

std::string columns_of(const Port& port, const char* verb) {
  std::string text;
  for (const ColumnRule& rule : port.columns) {
    text += fmt::format("{}{}", text.empty() ? verb : ", ", rule.column);
    if (!rule.parameter.empty()) text += fmt::format(" when {} = {}", rule.parameter, rule.value);
  }
  return text;
}

std::string port_line(const Port& port, std::size_t width, const char* verb) {
  std::vector<std::string> facts = {types_of(port)};
  if (!port.required)
    facts.emplace_back(verb == std::string_view("adds ") ? "where it applies" : "optional");
  if (port.many) facts.emplace_back("any number");
  std::string line = fmt::format("  {:<{}}  {}", port.name, width, facts.front());
  for (std::size_t i = 1; i < facts.size(); ++i) line += ", " + facts[i];
  const std::string columns = columns_of(port, verb);
  if (!columns.empty()) line += "; " + columns;
  line += "\n";
  if (!port.doc.empty()) line += wrapped(port.doc, width + 4);
  return line;
}

std::string ports(const char* heading, const std::vector<Port>& all, const char* verb) {
  if (all.empty()) return "";
  std::size_t width = 0;
  for (const Port& port : all) width = std::max(width, port.name.size());
  std::string text = fmt::format("\n{}\n", heading);
  for (const Port& port : all) text += port_line(port, width, verb);
  return text;
}

std::string default_of(const Parameter& parameter) {
  if (parameter.required) return "required";
  if (parameter.type == ParameterType::length_unit) return "default: the graph's units";
  if (!parameter.initial.is_set()) return "optional";
  // As people think of angles, and as their ranges are shown.
  if (const auto* radians = std::get_if<double>(&parameter.initial.value);
      radians != nullptr && parameter.type == ParameterType::angle)
    return fmt::format("default \"{:.6g} deg\"", *radians * 180.0 / std::numbers::pi);
  return "default " + graph::to_toml(parameter, parameter.initial);
}

std::string parameter_text(const Parameter& parameter, std::size_t width, std::size_t indent) {
  std::string facts =
      std::string(parameter.list ? "array of " : "") + std::string(name_of(parameter.type));
  if (!parameter.unit.empty()) facts += " [" + parameter.unit + "]";
  facts += ", " + default_of(parameter);
  const std::string range = graph::describe(parameter, parameter.range);
  if (!range.empty()) facts += ", " + range;
  if (!parameter.relative_to.empty()) facts += ", relative to '" + parameter.relative_to + "'";
  if (parameter.advanced) facts += ", advanced";
  std::string text = fmt::format("{:{}}{:<{}}  {}\n", "", indent, parameter.name, width, facts);
  const std::size_t inner = indent + width + 2;
  text += wrapped(parameter.doc, inner);
  for (const ChoiceOption& choice : parameter.choices)
    text += wrapped(choice.name + ": " + choice.doc, inner + 2);
  for (const Parameter& field : parameter.fields) text += parameter_text(field, 0, inner + 2);
  for (const std::string& old : parameter.old_names)
    text += wrapped("formerly '" + old + "'", inner);
  return text;
}

}  // namespace

std::string describe_text(const StageInfo& info, const std::string& example) {
  std::string text = fmt::format("{}\n{}", info.id, wrapped(info.summary, 2));
  text += ports("inputs", info.inputs, "needs ");
  text += ports("outputs", info.outputs, "adds ");
  if (!info.outputs.empty() && !info.keeps_columns) text += "  other columns are dropped\n";
  if (!info.parameters.empty()) {
    std::size_t width = 0;
    for (const Parameter& parameter : info.parameters)
      width = std::max(width, parameter.name.size());
    text += "\nparameters\n";
    for (const Parameter& parameter : info.parameters) text += parameter_text(parameter, width, 2);
  }
  text += fmt::format("\nversion {}, licence {}, determinism {}{}\n", info.version, info.licence,
                      name_of(info.determinism),
                      info.isolated ? ", in a process of its own unless isolate = false" : "");
  if (!info.references.empty()) text += "\nreferences\n";
  for (const std::string& reference : info.references) text += wrapped(reference, 2);
  if (!example.empty()) text += "\nexample\n";
  for (std::size_t begin = 0; begin < example.size();) {
    const std::size_t end = std::min(example.find('\n', begin), example.size());
    if (end > begin) text += "  " + example.substr(begin, end - begin);
    text += "\n";
    begin = end + 1;
  }
  return text;
}

std::string example_beside(const std::filesystem::path& plugin) {
  std::filesystem::path file = plugin;
  file.replace_extension(".toml");
  std::error_code failed;
  if (!std::filesystem::is_regular_file(file, failed)) return "";
  std::string text(FileContent(file).text());
  // Lines of the licence are no part of the example.
  while (text.rfind("# SPDX-", 0) == 0)
    text.erase(0, text.find('\n') == std::string::npos ? text.size() : text.find('\n') + 1);
  return text;
}

}  // namespace velum::plugins
