// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "plugins/call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <optional>

#include "graph/settings.hpp"

namespace velum::plugins {
namespace {

std::string types_of(const Port& port) {
  std::string text;
  for (const ValueType type : port.types)
    text += (text.empty() ? "" : " or ") + std::string(name_of(type));
  return text;
}

bool takes(const Port& port, const Value& value) {
  return std::find(port.types.begin(), port.types.end(), type_of(value)) != port.types.end();
}

void check_input(const StageInfo& info, const Port& port, const Wired& wired,
                 const std::vector<Setting>& settings) {
  if (wired.empty() && port.required)
    throw Error(Fault::graph,
                fmt::format("input '{}' ({}) is not wired", port.name, types_of(port)));
  if (wired.size() > 1 && !port.many)
    throw Error(Fault::graph,
                fmt::format("input '{}' takes one value, {} are wired", port.name, wired.size()));
  for (const Value& value : wired) {
    if (!takes(port, value))
      throw Error(Fault::graph, fmt::format("input '{}' takes a {}, it was given a {}", port.name,
                                            types_of(port), name_of(type_of(value))));
    const Cloud* points = points_of(value);
    for (const ColumnRule& rule : port.columns)
      if (points != nullptr && applies(rule, info, settings) && !points->has(rule.column))
        throw Error(Fault::stage, fmt::format("input '{}' needs the column '{}', which its {} does "
                                              "not have",
                                              port.name, rule.column, name_of(type_of(value))))
            .hint("put a stage that adds it before this one");
  }
}

struct OriginOf {
  std::optional<Eigen::Vector3d> operator()(const Cloud& cloud) const { return cloud.origin(); }
  std::optional<Eigen::Vector3d> operator()(const Mesh& mesh) const { return mesh.origin(); }
  std::optional<Eigen::Vector3d> operator()(const Surface& surface) const { return surface.origin; }
  std::optional<Eigen::Vector3d> operator()(const Clusters& clusters) const {
    return clusters.cloud.origin();
  }
  template <class Other>
  std::optional<Eigen::Vector3d> operator()(const Other&) const {
    return std::nullopt;
  }
};

struct MoveTo {
  const Eigen::Vector3d& origin;
  Value operator()(const Cloud& cloud) const { return cloud.with_origin(origin); }
  Value operator()(const Mesh& mesh) const {
    return mesh.with_vertices(mesh.vertices().with_origin(origin));
  }
  Value operator()(Surface surface) const {
    surface.control.colwise() += surface.origin - origin;
    surface.origin = origin;
    return surface;
  }
  Value operator()(Clusters clusters) const {
    clusters.cloud = clusters.cloud.with_origin(origin);
    return clusters;
  }
  template <class Other>
  Value operator()(const Other& other) const {
    return other;
  }
};

void to_one_origin(std::vector<Wired>& inputs) {
  std::optional<Eigen::Vector3d> common;
  for (Wired& wired : inputs) {
    for (Value& value : wired) {
      const auto origin = std::visit(OriginOf{}, value);
      if (!origin) continue;
      if (!common) common = origin;
      if (*origin != *common) value = std::visit(MoveTo{*common}, value);
    }
  }
}

const Wired* input_called(const StageInfo& info, const std::vector<Wired>& inputs,
                          const std::string& name) {
  for (std::size_t i = 0; i < info.inputs.size(); ++i)
    if (name.empty() || info.inputs[i].name == name) return &inputs[i];
  return nullptr;
}

Setting in_metres(const StageInfo& info, const Parameter& parameter, const Setting& setting,
                  const std::vector<Wired>& inputs) {
  if (!graph::is_relative(setting)) return setting;
  const Wired* wired = input_called(info, inputs, parameter.relative_to);
  const Cloud* points = wired == nullptr || wired->empty() ? nullptr : points_of(wired->front());
  if (points == nullptr) {
    throw Error(Fault::graph, fmt::format("'{}' is relative to the spacing or diagonal of an input "
                                          "that has no points",
                                          parameter.name))
        .hint("give it in metres or another unit of length");
  }
  // Of nothing any length will do: no point is measured with it.
  if (points->empty()) return graph::resolve(parameter, setting, 1.0, 1.0);
  const double spacing = points->spacing();
  const double diagonal = points->diagonal();
  const bool of_spacing = std::get<Length>(setting.value).of == Length::Of::spacing;
  if ((of_spacing ? spacing : diagonal) > 0.0 || parameter.range.contains(0.0))
    return graph::resolve(parameter, setting, spacing, diagonal);
  const std::string& port =
      parameter.relative_to.empty() ? info.inputs.front().name : parameter.relative_to;
  throw Error(Fault::stage,
              fmt::format("'{}' is relative to the {} of '{}', which has none: {}", parameter.name,
                          of_spacing ? "spacing" : "diagonal", port,
                          points->size() == 1
                              ? "it is one point"
                              : fmt::format("of its {} points {} at one place", points->size(),
                                            of_spacing ? "most lie by twos or more" : "all lie")))
      .hint(fmt::format("give {} in metres or another unit of length", parameter.name));
}

}  // namespace

const Cloud* points_of(const Value& value) {
  if (const auto* cloud = std::get_if<Cloud>(&value)) return cloud;
  if (const auto* mesh = std::get_if<Mesh>(&value)) return &mesh->vertices();
  if (const auto* clusters = std::get_if<Clusters>(&value)) return &clusters->cloud;
  return nullptr;
}

bool applies(const ColumnRule& rule, const StageInfo& info, const std::vector<Setting>& settings) {
  if (rule.parameter.empty()) return true;
  for (std::size_t i = 0; i < info.parameters.size(); ++i) {
    if (info.parameters[i].name != rule.parameter) continue;
    const auto& value = settings.at(i).value;
    if (const auto* text = std::get_if<std::string>(&value)) return *text == rule.value;
    if (const auto* flag = std::get_if<bool>(&value)) return *flag == (rule.value == "true");
    return settings.at(i).is_set() && graph::to_toml(info.parameters[i], settings[i]) == rule.value;
  }
  return false;
}

Call prepare(const StageInfo& info, std::vector<Setting> settings, std::vector<Wired> inputs) {
  if (inputs.size() > info.inputs.size())
    throw Error(Fault::graph, fmt::format("{} inputs are wired, the stage has {}", inputs.size(),
                                          info.inputs.size()));
  inputs.resize(info.inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i)
    check_input(info, info.inputs[i], inputs[i], settings);
  to_one_origin(inputs);
  for (std::size_t i = 0; i < settings.size(); ++i)
    settings[i] = in_metres(info, info.parameters.at(i), settings[i], inputs);
  if (info.check) info.check(settings);
  return {std::move(settings), std::move(inputs)};
}

std::string mismatch(const StageInfo& info, const Results& results) {
  if (results.size() != info.outputs.size())
    return fmt::format("the stage gave {} results, it has {} outputs", results.size(),
                       info.outputs.size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Port& port = info.outputs[i];
    if (!results[i] && port.required) return fmt::format("the stage made no '{}'", port.name);
    if (results[i] && !takes(port, *results[i]))
      return fmt::format("output '{}' is a {}, it should be a {}", port.name,
                         name_of(type_of(*results[i])), types_of(port));
  }
  return "";
}

Results invoke(const StageType& stage, const Call& call, Context& context) {
  try {
    Results results = stage.run(call.settings, call.inputs, context);
    const std::string fault = mismatch(stage.info(), results);
    if (!fault.empty()) throw Error(Fault::stage, fault);
    return results;
  } catch (const Error& error) {
    throw Error(error);
  } catch (const Cancelled&) {
    throw Cancelled();
  } catch (const std::bad_alloc&) {
    throw Error(Fault::stage, "the stage ran out of memory");
  } catch (const std::exception& error) {
    throw Error(Fault::stage, fmt::format("the stage threw a std::exception: {}", error.what()));
  } catch (...) {
    throw Error(Fault::stage, "the stage threw something that is not a std::exception");
  }
}

}  // namespace velum::plugins
