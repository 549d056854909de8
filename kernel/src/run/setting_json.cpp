// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/setting_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "velum/error.hpp"

namespace velum::run {
namespace {

// JSON has no infinity and no NaN.
Json number_to_json(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number > 0 ? "inf" : "-inf";
  return number;
}

double number_from_json(const Json& json) {
  if (json.is_number()) return json.get<double>();
  const auto text = json.get<std::string>();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (text == "inf") return kInfinity;
  if (text == "-inf") return -kInfinity;
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  throw Error(Fault::input, fmt::format("'{}' is not a number", text));
}

Json length_to_json(const Length& length) {
  if (length.of == Length::Of::metres) return number_to_json(length.value);
  return fmt::format("{} {}", length.value,
                     length.of == Length::Of::spacing ? "spacing" : "diagonal");
}

Json list_to_json(const Setting::List& list);

Json value_to_json(const Setting& setting) {
  struct Visitor {
    Json operator()(std::monostate) const { return nullptr; }
    Json operator()(double number) const { return number_to_json(number); }
    Json operator()(const Length& length) const { return length_to_json(length); }
    Json operator()(const Setting::List& list) const { return list_to_json(list); }
    Json operator()(bool flag) const { return flag; }
    Json operator()(std::int64_t integer) const { return integer; }
    Json operator()(const std::string& text) const { return text; }
  };
  return std::visit(Visitor{}, setting.value);
}

Json list_to_json(const Setting::List& list) {
  Json json = Json::array();
  for (const Setting& entry : list) json.push_back(value_to_json(entry));
  return json;
}

Json row_to_json(const Parameter& parameter, const Setting& row) {
  const auto& cells = std::get<Setting::List>(row.value);
  Json json = Json::object();
  for (std::size_t i = 0; i < parameter.fields.size(); ++i)
    json[parameter.fields[i].name] = to_json(parameter.fields[i], cells.at(i));
  return json;
}

Setting one_from_json(const Parameter& parameter, const Json& json) {
  switch (parameter.type) {
    case ParameterType::boolean:
      return {json.get<bool>()};
    case ParameterType::integer:
      return {json.get<std::int64_t>()};
    case ParameterType::number:
    case ParameterType::angle:
    case ParameterType::duration:
      return {number_from_json(json)};
    case ParameterType::length:
      return {Length(number_from_json(json))};
    case ParameterType::vector:
    case ParameterType::point: {
      Setting::List list;
      for (const Json& entry : json) list.push_back({number_from_json(entry)});
      return {std::move(list)};
    }
    case ParameterType::rows:
      return {Setting::List(from_json(parameter.fields, json))};
    default:
      return {json.get<std::string>()};
  }
}

bool is_list(const Parameter& parameter) {
  return parameter.list || parameter.type == ParameterType::rows;
}

}  // namespace

Json to_json(const Parameter& parameter, const Setting& setting) {
  if (parameter.type != ParameterType::rows || !setting.is_set()) return value_to_json(setting);
  Json json = Json::array();
  for (const Setting& row : std::get<Setting::List>(setting.value))
    json.push_back(row_to_json(parameter, row));
  return json;
}

Setting from_json(const Parameter& parameter, const Json& json) {
  try {
    if (json.is_null()) return {};
    if (!is_list(parameter)) return one_from_json(parameter, json);
    Setting::List list;
    for (const Json& entry : json) list.push_back(one_from_json(parameter, entry));
    return {std::move(list)};
  } catch (const nlohmann::json::exception& error) {
    throw Error(Fault::input, fmt::format("parameter '{}' cannot be read back: {}", parameter.name,
                                          error.what()));
  }
}

Json to_json(const std::vector<Parameter>& parameters, const std::vector<Setting>& settings) {
  Json json = Json::object();
  for (std::size_t i = 0; i < parameters.size() && i < settings.size(); ++i)
    json[parameters[i].name] = to_json(parameters[i], settings[i]);
  return json;
}

std::vector<Setting> from_json(const std::vector<Parameter>& parameters, const Json& json) {
  std::vector<Setting> settings;
  for (const Parameter& parameter : parameters) {
    const auto found = json.find(parameter.name);
    settings.push_back(found == json.end() ? Setting{} : from_json(parameter, *found));
  }
  return settings;
}

}  // namespace velum::run
