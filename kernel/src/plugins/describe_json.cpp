// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>

#include "graph/settings.hpp"
#include "plugins/describe.hpp"

namespace velum::plugins {
namespace {

using Json = nlohmann::ordered_json;

/// One type is text, several are an array.
Json types_of(const Port& port) {
  if (port.types.size() == 1) return name_of(port.types.front());
  Json all = Json::array();
  for (const ValueType type : port.types) all.push_back(name_of(type));
  return all;
}

/// A column is text; one that depends on a parameter says so in an object.
Json columns_of(const Port& port) {
  Json all = Json::array();
  for (const ColumnRule& rule : port.columns) {
    if (rule.parameter.empty())
      all.push_back(rule.column);
    else
      all.push_back({{"column", rule.column}, {"when", {{rule.parameter, rule.value}}}});
  }
  return all;
}

Json input(const Port& port) {
  return {{"name", port.name}, {"type", types_of(port)},    {"required", port.required},
          {"many", port.many}, {"needs", columns_of(port)}, {"doc", port.doc}};
}

Json output(const Port& port) {
  return {{"name", port.name},
          {"type", types_of(port)},
          {"required", port.required},
          {"adds", columns_of(port)},
          {"doc", port.doc}};
}

std::string unit_of(const Parameter& parameter) {
  switch (parameter.type) {
    case ParameterType::length:
    case ParameterType::point:
      return "m";
    case ParameterType::angle:
      return "rad";
    case ParameterType::duration:
      return "s";
    default:
      return parameter.unit;
  }
}

/// Relative lengths as they stand in a graph: "2 spacing".
struct ToJson {
  const Parameter& parameter;
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(bool value) const { return value; }
  Json operator()(std::int64_t value) const { return value; }
  Json operator()(double value) const { return value; }
  Json operator()(const std::string& value) const { return value; }
  Json operator()(const Length& length) const {
    if (length.of == Length::Of::metres) return length.value;
    std::string text = graph::to_toml(parameter, {length});
    return text.substr(1, text.size() - 2);  // without its quotes
  }
  Json operator()(const Setting::List& list) const {
    Json all = Json::array();
    for (const Setting& entry : list) all.push_back(std::visit(*this, entry.value));
    return all;
  }
};

Json range_of(const Range& range) {
  if (range.unbounded()) return nullptr;
  const auto bound = [](double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); };
  return {{"min", bound(range.low)},
          {"min_open", range.low_open},
          {"max", bound(range.high)},
          {"max_open", range.high_open}};
}

Json parameter_json(const Parameter& parameter) {
  Json choices = Json::array();
  for (const ChoiceOption& choice : parameter.choices)
    choices.push_back({{"name", choice.name}, {"doc", choice.doc}});
  Json json = {{"name", parameter.name},
               {"type", name_of(parameter.type)},
               {"list", parameter.list},
               {"unit", unit_of(parameter)},
               {"default", std::visit(ToJson{parameter}, parameter.initial.value)},
               {"required", parameter.required},
               {"range", range_of(parameter.range)},
               {"choices", choices},
               {"doc", parameter.doc},
               {"advanced", parameter.advanced},
               {"old_names", parameter.old_names}};
  if (parameter.required) json["default"] = nullptr;
  if (!parameter.relative_to.empty()) json["relative_to"] = parameter.relative_to;
  if (!parameter.fields.empty()) {
    json["fields"] = Json::array();
    for (const Parameter& field : parameter.fields) json["fields"].push_back(parameter_json(field));
  }
  return json;
}

template <class All, class Make>
Json array_of(const All& all, const Make& make) {
  Json json = Json::array();
  for (const auto& one : all) json.push_back(make(one));
  return json;
}

}  // namespace

Json describe_json(const StageInfo& info, const std::string& example) {
  return {{"id", info.id},
          {"version", info.version},
          {"summary", info.summary},
          {"inputs", array_of(info.inputs, input)},
          {"outputs", array_of(info.outputs, output)},
          {"keeps_columns", info.keeps_columns},
          {"parameters", array_of(info.parameters, parameter_json)},
          {"determinism", name_of(info.determinism)},
          {"isolated", info.isolated},
          {"references", info.references},
          {"licence", info.licence},
          {"example", example}};
}

}  // namespace velum::plugins
