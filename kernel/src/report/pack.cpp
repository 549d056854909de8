// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Views as the page reads them, and back.
#include <map>

#include "report/views.hpp"

namespace velum::report {
namespace {

using run::Json;

/// Lays arrays out one after the other, those of the same content once.
class Block {
 public:
  std::size_t place(const Bytes& array) {
    constexpr std::size_t kAlignment = 4;
    const auto [found, fresh] = places_.emplace(array.key(), bytes_.size());
    if (fresh) {
      bytes_.insert(bytes_.end(), array.bytes().begin(), array.bytes().end());
      bytes_.resize((bytes_.size() + kAlignment - 1) / kAlignment * kAlignment);
    }
    return found->second;
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::map<Bytes::Key, std::size_t> places_;
  std::vector<std::byte> bytes_;
};

Json to_json(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

Json to_json(const ViewColumn& column, Block& block) {
  Json json = {{"name", column.name},
               {"unit", column.unit},
               {"kind", column.label ? "label" : "number"},
               {"at", block.place(column.data)}};
  if (!column.label) {
    json["lo"] = column.lo;
    json["hi"] = column.hi;
  } else {
    json["bits"] = column.bits;
    if (!column.names.empty()) json["names"] = column.names;
  }
  return json;
}

void add_geometry(const View& view, Block& block, Json& json) {
  json["origin"] = to_json(view.origin);
  json["positions"] = {
      {"at", block.place(view.positions)}, {"lo", to_json(view.lo)}, {"hi", to_json(view.hi)}};
  if (view.triangles.there()) {
    const auto bytes = static_cast<std::size_t>(view.index_bits) / 8;
    json["triangles"] = {{"at", block.place(view.triangles)},
                         {"count", view.triangles.size() / (3 * bytes)},
                         {"bits", view.index_bits}};
  }
  json["columns"] = Json::array();
  for (const ViewColumn& column : view.columns) json["columns"].push_back(to_json(column, block));
  json["sensors"] = Json::array();
  for (const Sensor& sensor : view.sensors)
    json["sensors"].push_back(
        {{"position", to_json(sensor.pose.translation())}, {"name", sensor.name}});
}

Json to_json(const View& view, Block& block) {
  Json json = {{"id", view.id()},       {"node", view.node},
               {"output", view.output}, {"type", name_of(view.type)},
               {"count", view.count},   {"shown", view.shown}};
  if (!view.variant.empty()) json["variant"] = view.variant;
  if (view.positions.there()) add_geometry(view, block, json);
  if (!view.rows.is_null()) json["rows"] = view.rows;
  if (!view.matrix.is_null()) json["matrix"] = view.matrix;
  return json;
}

Json to_json(const Histogram& histogram, const std::string& value) {
  Json json = {{"value", value},           {"name", histogram.name},  {"unit", histogram.unit},
               {"lo", histogram.lo},       {"hi", histogram.hi},      {"counts", histogram.counts},
               {"below", histogram.below}, {"above", histogram.above}};
  if (!histogram.better.empty()) json["better"] = histogram.better;
  return json;
}

Eigen::Vector3d vector_of(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

/// Reads arrays out of a block.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> block) : block_(block) {}

  [[nodiscard]] Bytes bytes(const Json& at, std::uint64_t count, std::uint64_t size) const {
    const auto begin = at.get<std::uint64_t>();
    if (begin > block_.size() || count > (block_.size() - begin) / size)
      throw Error(Fault::input, "an array of the views lies outside of the data");
    const auto part = block_.subspan(begin, count * size);
    return Bytes(std::vector<std::byte>(part.begin(), part.end()));
  }

 private:
  std::span<const std::byte> block_;
};

ViewColumn column_of(const Json& json, std::uint64_t count, const Reader& reader) {
  ViewColumn column{.name = json.at("name").get<std::string>(),
                    .unit = json.at("unit").get<std::string>(),
                    .label = json.at("kind").get<std::string>() == "label"};
  if (column.label) {
    column.bits = json.at("bits").get<int>() == 32 ? 32 : 16;
    if (json.contains("names")) column.names = json.at("names").get<std::vector<std::string>>();
  } else {
    column.lo = json.at("lo").get<double>();
    column.hi = json.at("hi").get<double>();
  }
  column.data = reader.bytes(json.at("at"), count, static_cast<std::uint64_t>(column.bits) / 8);
  return column;
}

void read_geometry(const Json& json, const Reader& reader, View& view) {
  view.origin = vector_of(json.at("origin"));
  const Json& positions = json.at("positions");
  view.lo = vector_of(positions.at("lo"));
  view.hi = vector_of(positions.at("hi"));
  view.positions = reader.bytes(positions.at("at"), view.shown, 3 * sizeof(std::uint16_t));
  if (json.contains("triangles")) {
    const Json& triangles = json.at("triangles");
    view.index_bits = triangles.at("bits").get<int>() == 32 ? 32 : 16;
    view.triangles = reader.bytes(triangles.at("at"), triangles.at("count").get<std::uint64_t>(),
                                  3 * static_cast<std::uint64_t>(view.index_bits) / 8);
    for (const std::uint32_t index : indices_of(view))
      if (index >= view.shown)
        throw Error(Fault::input, "a triangle of the views names a vertex that is not there");
  }
  for (const Json& column : json.at("columns"))
    view.columns.push_back(column_of(column, view.shown, reader));
  for (const Json& sensor : json.at("sensors")) {
    Sensor& made = view.sensors.emplace_back();
    made.name = sensor.at("name").get<std::string>();
    made.pose.translation() = vector_of(sensor.at("position"));
  }
}

ValueType type_named(const std::string& name) {
  for (std::size_t i = 0; i < std::variant_size_v<Value>; ++i)
    if (name == name_of(static_cast<ValueType>(i))) return static_cast<ValueType>(i);
  throw Error(Fault::input, "the views have a value of the unknown type '" + name + "'");
}

View view_of(const Json& json, const Reader& reader) {
  View view;
  view.node = json.at("node").get<std::string>();
  view.output = json.at("output").get<std::string>();
  view.variant = json.value("variant", "");
  view.type = type_named(json.at("type").get<std::string>());
  view.count = json.at("count").get<std::uint64_t>();
  view.shown = json.at("shown").get<std::uint64_t>();
  if (json.contains("positions")) read_geometry(json, reader, view);
  if (json.contains("rows")) view.rows = json.at("rows");
  if (json.contains("matrix")) view.matrix = json.at("matrix");
  return view;
}

Histogram histogram_of(const Json& json) {
  return {.name = json.at("name").get<std::string>(),
          .unit = json.at("unit").get<std::string>(),
          .better = json.value("better", ""),
          .lo = json.at("lo").get<double>(),
          .hi = json.at("hi").get<double>(),
          .counts = json.at("counts").get<std::vector<std::uint64_t>>(),
          .below = json.at("below").get<std::uint64_t>(),
          .above = json.at("above").get<std::uint64_t>()};
}

}  // namespace

Packed pack(const std::vector<View>& views) {
  Packed packed;
  Block block;
  for (const View& view : views) {
    packed.values.push_back(to_json(view, block));
    for (const Histogram& histogram : view.histograms)
      packed.histograms.push_back(to_json(histogram, view.id()));
  }
  packed.block = block.take();
  return packed;
}

std::vector<View> unpack(const Json& values, const Json& histograms,
                         std::span<const std::byte> block) {
  try {
    const Reader reader(block);
    std::vector<View> views;
    std::map<std::string, std::size_t> places;
    for (const Json& value : values) {
      places[value.at("id").get<std::string>()] = views.size();
      views.push_back(view_of(value, reader));
      views.back().order = views.size() - 1;
    }
    for (const Json& histogram : histograms)
      views.at(places.at(histogram.at("value").get<std::string>()))
          .histograms.push_back(histogram_of(histogram));
    return views;
  } catch (const Json::exception& error) {
    throw Error(Fault::input, std::string("the views are damaged: ") + error.what());
  } catch (const std::out_of_range&) {
    throw Error(Fault::input, "the views are damaged: a histogram of no value");
  }
}

}  // namespace velum::report
