// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/record.hpp"

#include <fmt/format.h>

#include <array>
#include <span>

#include "run/machine.hpp"
#include "run/node_error.hpp"
#include "velum/files.hpp"

namespace velum::run {
namespace {

// E10 is what goes wrong in a run; then comes the exit status.
std::string code_of(Fault fault) {
  return fault == Fault::stage ? "E1001" : fmt::format("E10{}0", static_cast<int>(fault));
}

// "read by node 'scan' (io.read_cloud)"
std::string by_node(const char* what, const Failure& failure) {
  return fmt::format("  {} node '{}' ({})\n", what, failure.node, failure.stage);
}

}  // namespace

std::string_view name_of(Status status) {
  static constexpr std::array<std::string_view, 5> kNames = {"ok", "cached", "failed", "skipped",
                                                             "interrupted"};
  return kNames.at(static_cast<std::size_t>(status));
}

std::string_view name_of(Better better) {
  static constexpr std::array<std::string_view, 3> kNames = {"lower", "higher", "neither"};
  return kNames.at(static_cast<std::size_t>(better));
}

Failure failure_of(const Error& error, const std::string& node, const std::string& stage) {
  const auto* coded = dynamic_cast<const CodedError*>(&error);
  return {error.fault(), coded == nullptr ? code_of(error.fault()) : coded->code(),
          node,          stage,
          error.what(),  error.where(),
          error.hint()};
}

std::string format(const Failure& failure) {
  std::string text;
  const bool file = failure.fault == Fault::input || failure.fault == Fault::output;
  if (file && !failure.where.empty()) {
    text = fmt::format("error[{}] {}  {}\n", failure.code, failure.where, failure.message);
    text += by_node(failure.fault == Fault::input ? "read by" : "written by", failure);
  } else {
    text = fmt::format("error[{}] node '{}' ({}): {}\n", failure.code, failure.node, failure.stage,
                       failure.message);
    if (!failure.where.empty()) text += "  at " + failure.where + "\n";
  }
  if (!failure.hint.empty()) text += "  " + failure.hint + "\n";
  return text;
}

FileRecord describe_file(const std::filesystem::path& path) {
  const FileContent content(path);
  return {path.string(), "", content.size(), hash_of(content.bytes())};
}

Json to_json(const Failure& failure) {
  return {{"code", failure.code},       {"node", failure.node},   {"stage", failure.stage},
          {"message", failure.message}, {"where", failure.where}, {"hint", failure.hint}};
}

Json to_json(const Measures& measures) {
  Json json = Json::object();
  for (const auto& [name, measure] : measures)
    json[name] = {
        {"value", measure.value}, {"unit", measure.unit}, {"better", name_of(measure.better)}};
  return json;
}

Measures measures_from_json(const Json& json) {
  Measures measures;
  for (const auto& [name, entry] : json.items()) {
    Measure& measure = measures[name];
    const Json& value = entry.at("value");
    measure.value =
        value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
    measure.unit = entry.at("unit").get<std::string>();
    const auto better = entry.at("better").get<std::string>();
    for (const Better each : {Better::lower, Better::higher, Better::neither})
      if (better == name_of(each)) measure.better = each;
  }
  return measures;
}

Json to_json(const NodeRecord& node) {
  Json json = {{"name", node.name},
               {"use", node.use},
               {"version", node.version},
               {"plugin_hash", node.plugin_hash},
               {"status", name_of(node.status)},
               {"seconds", node.seconds},
               {"cpu_seconds", or_null(node.cpu_seconds)},
               {"peak_bytes", or_null(node.peak_bytes)},
               {"parameters", node.parameters},
               {"in", node.in},
               {"out", node.out},
               {"measures", to_json(node.measures)},
               {"warnings", node.warnings}};
  if (node.failure) json["error"] = to_json(*node.failure);
  return json;
}

Json to_json(const FileRecord& file) {
  Json json = {{"path", file.path}};
  if (!file.node.empty()) json["node"] = file.node;
  json["bytes"] = file.bytes;
  json["hash"] = file.hash;
  return json;
}

Json to_json(const RunRecord& record) {
  const auto list = [](const auto& entries) {
    Json json = Json::array();
    for (const auto& entry : entries) json.push_back(to_json(entry));
    return json;
  };
  return {{"velum", kVersion},
          {"graph",
           {{"path", record.graph_path},
            {"title", record.graph_title},
            {"hash", hash_of(std::as_bytes(std::span(record.graph_resolved)))},
            {"resolved", record.graph_resolved}}},
          {"status", name_of(record.status)},
          {"started", record.started},
          {"seconds", record.seconds},
          {"cpu_seconds", record.cpu_seconds},
          {"peak_bytes", record.peak_bytes},
          {"threads", record.threads},
          {"seed", record.seed},
          {"machine", machine()},
          {"nodes", list(record.nodes)},
          {"files", list(record.files)},
          {"inputs", list(record.inputs)},
          {"error", record.failure ? to_json(*record.failure) : Json(nullptr)}};
}

}  // namespace velum::run
