// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "graph/schema.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "graph/settings.hpp"
#include "graph/toml.hpp"
#include "graph/units.hpp"

namespace velum::graph {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kNumber = R"([-+]?[0-9.]+([eE][-+]?[0-9]+)?)";
constexpr const char* kName = "^[A-Za-z0-9_-]+$";
constexpr const char* kWire = R"(^[A-Za-z0-9_-]+(\.[A-Za-z0-9_]+)?$)";

Json reference(std::string_view definition) {
  return {{"$ref", fmt::format("#/definitions/{}", definition)}};
}

Json text(std::string_view description) {
  return {{"type", "string"}, {"description", description}};
}

/// A bare number, or text with one of the units.
Json quantity(const std::vector<std::string>& units, const char* description) {
  const std::string pattern = fmt::format("^{} *({})$", kNumber, fmt::join(units, "|"));
  return {{"description", description},
          {"anyOf", {{{"type", "number"}}, {{"type", "string"}, {"pattern", pattern}}}}};
}

Json three(Json item) {
  return {{"type", "array"}, {"items", std::move(item)}, {"minItems", 3}, {"maxItems", 3}};
}

Json quantities() {
  std::vector<std::string> lengths = length_units();
  const Json place = quantity(lengths, "a length; bare: in the units of the file");
  lengths.insert(lengths.end(), relative_units().begin(), relative_units().end());
  Json all;
  all["length"] = quantity(lengths, "a length; bare: in the units of the file");
  all["angle"] = quantity(angle_units(), "an angle; bare: degrees");
  all["duration"] = quantity(duration_units(), "a time; bare: seconds");
  all["vector"] = three({{"type", "number"}});
  all["point"] = three(place);
  all["length_unit"] = {{"enum", length_units()}};
  all["wire"] = {{"type", "string"}, {"pattern", kWire}, {"description", "node or node.output"}};
  return all;
}

void limit(Json& schema, const Range& range) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (range.low > -kInfinity) schema[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
  if (range.high < kInfinity) schema[range.high_open ? "exclusiveMaximum" : "maximum"] = range.high;
}

Json object_of(const std::vector<Parameter>& parameters);

Json choices(const Parameter& parameter) {
  Json options = Json::array();
  for (const ChoiceOption& option : parameter.choices)
    options.push_back({{"const", option.name}, {"description", option.doc}});
  return {{"oneOf", std::move(options)}};
}

Json number(const Parameter& parameter) {
  Json bare = {{"type", "number"}};
  limit(bare, parameter.range);
  const std::string unit = parameter.unit.empty() ? "%" : parameter.unit;
  return {{"anyOf",
           {std::move(bare),
            {{"type", "string"}, {"pattern", fmt::format("^{} *{}$", kNumber, unit)}}}}};
}

Json single(const Parameter& parameter) {
  switch (parameter.type) {
    case ParameterType::boolean:
      return {{"type", "boolean"}};
    case ParameterType::integer: {
      Json integer = {{"type", "integer"}};
      limit(integer, parameter.range);
      return integer;
    }
    case ParameterType::number:
      return number(parameter);
    case ParameterType::choice:
      return choices(parameter);
    case ParameterType::rows:
      return {{"type", "array"}, {"items", object_of(parameter.fields)}};
    case ParameterType::text:
    case ParameterType::input_file:
    case ParameterType::output_file:
      return {{"type", "string"}};
    default:
      return {{"allOf", {reference(name_of(parameter.type))}}};
  }
}

Json plain(const toml::Node& value) {
  switch (value.kind) {
    case toml::Kind::boolean:
      return value.boolean;
    case toml::Kind::integer:
      return value.integer;
    case toml::Kind::number:
      return value.number;
    case toml::Kind::array: {
      Json items = Json::array();
      for (const toml::Node& item : value.items) items.push_back(plain(item));
      return items;
    }
    case toml::Kind::table: {
      Json entries = Json::object();
      for (const toml::Entry& entry : value.entries) entries[entry.key] = plain(entry.value);
      return entries;
    }
    default:
      return value.text;
  }
}

Json of(const Parameter& parameter) {
  Json schema = single(parameter);
  if (parameter.list) schema = {{"type", "array"}, {"items", std::move(schema)}};
  std::string description = parameter.doc;
  if (const std::string range = describe(parameter, parameter.range); !range.empty())
    description += fmt::format(" ({})", range);
  schema["description"] = description;
  if (parameter.initial.is_set() && !parameter.required)
    schema["default"] = plain(toml::parse_value(to_toml(parameter, parameter.initial)));
  return schema;
}

Json object_of(const std::vector<Parameter>& parameters) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const Parameter& parameter : parameters) {
    properties[parameter.name] = of(parameter);
    for (const std::string& old : parameter.old_names) {
      properties[old] = of(parameter);
      properties[old]["description"] = fmt::format("now called '{}'", parameter.name);
    }
    if (parameter.required && parameter.old_names.empty()) required.push_back(parameter.name);
  }
  Json schema = {
      {"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = std::move(required);
  return schema;
}

Json wires(const Port& port) {
  if (!port.many) return reference("wire");
  const Json list = {{"type", "array"}, {"items", reference("wire")}, {"minItems", 1}};
  return {{"anyOf", {reference("wire"), list}}};
}

Json inputs(const std::vector<Port>& ports) {
  Json properties = Json::object();
  for (const Port& port : ports) {
    std::vector<std::string_view> types;
    for (const ValueType type : port.types) types.push_back(name_of(type));
    properties[port.name] = {{"allOf", {wires(port)}},
                             {"description", fmt::format("{}{}{}", fmt::join(types, " or "),
                                                         port.doc.empty() ? "" : ": ", port.doc)}};
    // A port may be called by the type of what is wired, too.
    for (const std::string_view type : types)
      if (!properties.contains(type)) properties[std::string(type)] = wires(port);
  }
  const Json named = {
      {"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  return {{"description", "where the inputs come from"}, {"anyOf", {wires(ports.front()), named}}};
}

void add_node_keys(Json& properties) {
  properties["title"] = text("shown in reports");
  properties["isolate"] = {{"type", "boolean"},
                           {"description", "run in a process of its own, within its limits"}};
  properties["allow_empty"] = {{"type", "boolean"}, {"description", "an empty result is no error"}};
  properties["cache"] = {{"type", "boolean"}, {"description", "false: always run again"}};
  properties["seed"] = {{"type", "integer"}, {"minimum", 0}};
  const std::string memory = fmt::format("^{} *({})$", kNumber, fmt::join(byte_units(), "|"));
  properties["limits"] = {
      {"type", "object"},
      {"properties",
       {{"time", reference("duration")}, {"memory", {{"type", "string"}, {"pattern", memory}}}}},
      {"additionalProperties", false}};
}

Json stage(const StageInfo& info) {
  Json schema = object_of(info.parameters);
  schema["description"] = info.summary;
  if (std::ranges::any_of(info.inputs, &Port::required)) schema["required"].push_back("in");
  Json& properties = schema.at("properties");
  properties["use"] = {{"const", info.id}, {"description", info.summary}};
  if (!info.inputs.empty()) properties["in"] = inputs(info.inputs);
  add_node_keys(properties);
  return schema;
}

/// `use` chooses what else a node may say.
Json node(const std::vector<const StageInfo*>& stages) {
  Json uses = Json::array();
  Json rules = Json::array();
  for (const StageInfo* info : stages) {
    uses.push_back({{"const", info->id}, {"description", info->summary}});
    rules.push_back({{"if", {{"properties", {{"use", {{"const", info->id}}}}}}},
                     {"then", reference("stage." + info->id)}});
  }
  Json schema = {{"type", "object"}, {"required", {"use"}}};
  schema["properties"]["use"] = {{"type", "string"}, {"oneOf", std::move(uses)}};
  schema["allOf"] = std::move(rules);
  return schema;
}

Json slurm() {
  const Json count = {{"type", "integer"}, {"minimum", 1}};
  Json schema = {{"type", "object"}, {"additionalProperties", false}};
  schema["properties"] = {{"account", text("that is charged")},
                          {"partition", text("where the tasks run")},
                          {"time", text("longest time of a task, as \"2 h\"")},
                          {"memory", text("memory of a task, as \"4 GB\"")},
                          {"cpus", count},
                          {"cells", count},
                          {"array", count},
                          {"options", {{"type", "array"}, {"items", {{"type", "string"}}}}}};
  return schema;
}

Json study() {
  const Json strings = {{"type", "array"}, {"items", {{"type", "string"}}}};
  Json axis = {{"type", "object"}, {"additionalProperties", false}};
  const Json tables = {{"type", "array"}, {"items", {{"type", "object"}}}};
  const Json count = {{"type", "integer"}, {"minimum", 1}};
  axis["properties"] = {{"title", text("of the axis")},
                        {"zip", text("axes of one name go along together")},
                        {"node", text("the node that is varied")},
                        {"alternatives", tables},
                        {"param", text("node.parameter that is varied")},
                        {"values", {{"type", "array"}}},
                        {"range", {{"type", "object"}, {"required", {"from", "to", "steps"}}}},
                        {"files", text("a pattern: one value a file")},
                        {"rows", tables}};
  Json schema = {{"type", "object"}, {"additionalProperties", false}};
  schema["properties"] = {{"title", text("of the study")},
                          {"repeat", count},
                          {"seed", count},
                          {"measure", strings},
                          {"exclude", tables},
                          {"sample", count},
                          {"reference", {{"type", "object"}}},
                          {"timing", {{"enum", {"shared", "exclusive"}}}},
                          {"timeout", text("longest time of a cell, as \"60 s\"")},
                          {"memory", text("most memory of a cell, as \"2 GB\"")},
                          {"slurm", slurm()},
                          {"vary", {{"type", "array"}, {"items", std::move(axis)}}}};
  return schema;
}

}  // namespace

std::string schema(Catalog& catalog) {
  std::vector<const StageInfo*> stages;
  for (const std::string& id : catalog.ids())
    if (const StageInfo* info = catalog.find(id)) stages.push_back(info);

  Json root = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Velum graph"}};
  root["type"] = "object";
  root["additionalProperties"] = false;
  Json& properties = root["properties"];
  properties["format"] = {{"const", 1}, {"description", "version of the language of graphs"}};
  properties["title"] = text("of the graph");
  properties["units"] = {{"enum", length_units()}, {"description", "of bare lengths"}};
  const Json files = {{"type", "array"}, {"items", {{"type", "string"}}}};
  properties["include"] = {{"description", "files whose nodes are merged"},
                           {"anyOf", {{{"type", "string"}}, files}}};
  properties["node"] = {{"type", "object"},
                        {"propertyNames", {{"pattern", kName}, {"not", {{"const", "total"}}}}},
                        {"additionalProperties", reference("node")}};
  properties["study"] = study();
  Json& definitions = root["definitions"];
  definitions = quantities();
  definitions["node"] = node(stages);
  for (const StageInfo* info : stages) definitions["stage." + info->id] = stage(*info);
  return root.dump(2) + "\n";
}

}  // namespace velum::graph
