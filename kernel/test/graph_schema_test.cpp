// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include <functional>
#include <regex>

#include <nlohmann/json.hpp>

#include "fake_catalog.hpp"
#include "graph/schema.hpp"

using nlohmann::json;

namespace {

const json& schema() {
  static fake::Catalog catalog;
  static const json parsed = json::parse(velum::graph::schema(catalog));
  return parsed;
}

const json& stage(const std::string& id) {
  return schema().at("definitions").at("stage." + id);
}
const json& parameter(const std::string& id, const std::string& name) {
  return stage(id).at("properties").at(name);
}

/// Calls `visit` with every object within.
void each(const json& value, const std::function<void(const json&)>& visit) {
  if (value.is_object()) visit(value);
  if (value.is_structured())
    for (const auto& part : value) each(part, visit);
}

}  // namespace

TEST_CASE("the schema says which one it is, and its references lead somewhere") {
  CHECK(schema().at("$schema") == "http://json-schema.org/draft-07/schema#");
  int references = 0;
  each(schema(), [&](const json& object) {
    if (!object.contains("$ref")) return;
    const std::string target = object.at("$ref");
    REQUIRE(target.starts_with("#/definitions/"));
    CHECK(schema().at("definitions").contains(target.substr(14)));
    ++references;
  });
  CHECK(references > 40);
}

TEST_CASE("nothing in the schema is a pair of values where an object was meant") {
  each(schema(), [](const json& object) {
    for (const char* key : {"properties", "items", "additionalProperties", "then", "if"})
      if (object.contains(key) && !object.at(key).is_boolean()) CHECK(object.at(key).is_object());
    for (const char* key : {"anyOf", "oneOf", "allOf", "required", "enum"})
      if (object.contains(key) && !object.at(key).is_object()) CHECK(object.at(key).is_array());
  });
}

TEST_CASE("every stage is described; those that do not load are left out") {
  const json& uses = schema().at("definitions").at("node").at("properties").at("use").at("oneOf");
  CHECK(uses.size() == 13);
  CHECK(uses.at(0).at("const") == "analysis.mesh_to_reference");
  CHECK_FALSE(schema().at("definitions").contains("stage.features.broken"));
  CHECK(stage("features.normals").at("description") == "Normals and curvature.");
  CHECK(stage("features.normals").at("additionalProperties") == false);
}

TEST_CASE("parameters have type, range, default and description") {
  const json& neighbours = parameter("features.normals", "neighbours");
  CHECK(neighbours.at("type") == "integer");
  CHECK(neighbours.at("minimum") == 3);
  CHECK(neighbours.at("default") == 30);
  CHECK(neighbours.at("description") == "points of a neighbourhood (at least 3)");
  CHECK(parameter("meshing.delaunay_projected", "max_edge").at("default") == "5 spacing");
  CHECK(parameter("meshing.delaunay_projected", "max_edge").at("allOf").at(0).at("$ref") ==
        "#/definitions/length");
  CHECK(parameter("registration.icp", "trimmed").at("type") == "boolean");
  const json& share = parameter("registration.icp", "overlap").at("anyOf");
  CHECK(share.at(0).at("maximum") == 1.0);
  CHECK(share.at(1).at("type") == "string");
  CHECK(parameter("registration.svd", "weights").at("type") == "array");
  CHECK(parameter("registration.svd", "up").at("default") == json({0, 0, 1}));
}

TEST_CASE("choices are documented") {
  const json& options = parameter("registration.icp", "metric").at("oneOf");
  REQUIRE(options.size() == 2);
  CHECK(options.at(1).at("const") == "point_to_plane");
  CHECK(options.at(1).at("description") == "distances to planes");
}

TEST_CASE("what must be given is required, unless its old name will do") {
  CHECK(stage("io.read_cloud").at("required") == json({"file"}));
  CHECK(stage("resampling.voxel_grid").at("required") == json({"in"}));
  CHECK(parameter("resampling.voxel_grid", "leaf").at("description") == "now called 'size'");
  CHECK_FALSE(stage("devices.simulator").contains("required"));
}

TEST_CASE("inputs") {
  CHECK_FALSE(stage("devices.simulator").at("properties").contains("in"));
  const json& in = parameter("registration.icp", "in").at("anyOf");
  CHECK(in.at(0).at("$ref") == "#/definitions/wire");
  CHECK(in.at(1).at("properties").contains("target"));
  const json& many = parameter("filtering.merge", "in").at("anyOf").at(0).at("anyOf");
  CHECK(many.at(1).at("type") == "array");
  const json& either = parameter("filtering.select_cluster", "in").at("anyOf").at(1);
  CHECK(either.at("properties").contains("clusters"));
  CHECK(either.at("properties").contains("cloud"));
}

TEST_CASE("rows are arrays of tables") {
  const json& pairs = parameter("registration.svd", "pairs");
  CHECK(pairs.at("type") == "array");
  CHECK(pairs.at("items").at("properties").at("source").at("allOf").at(0).at("$ref") ==
        "#/definitions/point");
  CHECK(pairs.at("default") == json::array());
}

TEST_CASE("patterns take what the checks take") {
  const std::string pattern =
      schema().at("definitions").at("length").at("anyOf").at(1).at("pattern");
  const std::regex length(pattern);
  for (const char* good : {"5 mm", "5mm", "-0.5e-3 m", "2 spacing", "1 % diagonal"})
    CHECK(std::regex_match(good, length));
  for (const char* bad : {"5", "mm", "5 apples", "5 mm mm"})
    CHECK_FALSE(std::regex_match(bad, length));
}
