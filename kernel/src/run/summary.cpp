// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/summary.hpp"

#include <fmt/format.h>

#include <array>

namespace velum::run {
namespace {

Json column_names(const Cloud& cloud) {
  Json names = Json::array();
  for (const auto& [name, column] : cloud.columns()) names.push_back(name);
  return names;
}

struct Summary {
  Json& json;

  void operator()(const Cloud& cloud) const {
    json["points"] = cloud.size();
    json["columns"] = column_names(cloud);
    json["sensors"] = cloud.sensors().size();
    if (cloud.origin() != Eigen::Vector3d::Zero())
      json["origin"] = {cloud.origin().x(), cloud.origin().y(), cloud.origin().z()};
  }
  void operator()(const Mesh& mesh) const {
    json["triangles"] = mesh.size();
    json["vertices"] = mesh.vertices().size();
    json["columns"] = column_names(mesh.vertices());
  }
  void operator()(const Surface& surface) const {
    json["control_points"] = surface.control.cols();
    json["degrees"] = {surface.degree_u, surface.degree_v};
    json["trimming_loops"] = surface.trimming.size();
  }
  void operator()(const Transform& transform) const {
    json["source"] = transform.source;
    json["target"] = transform.target;
    if (transform.fitness >= 0.0) json["fitness"] = transform.fitness;
    Json rows = Json::array();
    for (int row = 0; row < 4; ++row) {
      const Eigen::RowVector4d r = transform.matrix.matrix().row(row);
      rows.push_back({r[0], r[1], r[2], r[3]});
    }
    json["matrix"] = std::move(rows);
  }
  void operator()(const Clusters& clusters) const {
    json["clusters"] = clusters.kinds.size();
    json["points"] = clusters.cloud.size();
  }
  void operator()(const Correspondences& pairs) const { json["pairs"] = pairs.source.count(); }
  void operator()(const Table& table) const {
    json["rows"] = table.size();
    Json names = Json::array();
    for (const auto& heading : table.headings()) names.push_back(heading.name);
    json["columns"] = std::move(names);
  }
};

// In the order in which they are said; a transform is told by its fitness only.
constexpr std::array kCounts = {"clusters",       "points", "triangles", "vertices",
                                "control_points", "pairs",  "rows"};

std::string with_commas(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, ",");
  return text;
}

}  // namespace

Json summarise(const Value& value) {
  Json json = {{"type", name_of(type_of(value))}, {"hash", hash_of(value)}};
  std::visit(Summary{json}, value);
  return json;
}

std::string in_words(const Json& summary) {
  std::string text;
  for (const char* name : kCounts) {
    const auto found = summary.find(name);
    if (found == summary.end()) continue;
    const auto count = found->get<std::uint64_t>();
    std::string noun = name;
    if (noun == "control_points") noun = "control points";
    if (count == 1) noun = noun == "vertices" ? "vertex" : noun.substr(0, noun.size() - 1);
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", with_commas(count), noun);
  }
  return text.empty() ? summary.value("type", "") : text;
}

double amount(const Json& summary) {
  for (const char* name : {"points", "triangles", "rows"}) {
    const auto found = summary.find(name);
    if (found != summary.end()) return found->get<double>();
  }
  return -1.0;
}

}  // namespace velum::run
