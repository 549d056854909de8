// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "report/view.hpp"

#include <algorithm>
#include <cmath>

#include "report/histogram.hpp"
#include "report/quantise.hpp"
#include "report/surface_mesh.hpp"

namespace velum::report {
namespace {

using run::Json;

Json cell_json(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell))
    return std::isfinite(*number) ? Json(*number) : Json(nullptr);
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return *whole;
  return std::get<std::string>(cell);
}

std::size_t rows_shown(const Table& table) {
  const std::size_t columns = std::max<std::size_t>(table.headings().size(), 1);
  return std::min({table.size(), kMostRows, std::max<std::size_t>(kMostTableCells / columns, 1)});
}

void add_rows(const Table& table, View& view) {
  Json headings = Json::array();
  for (const auto& heading : table.headings())
    headings.push_back({{"name", heading.name}, {"unit", heading.unit}});
  Json rows = Json::array();
  const std::size_t shown = rows_shown(table);
  for (std::size_t i = 0; i < shown; ++i) {
    Json row = Json::array();
    for (const Cell& cell : table.rows()[i * table.size() / shown]) row.push_back(cell_json(cell));
    rows.push_back(std::move(row));
  }
  view.rows = {{"columns", std::move(headings)}, {"rows", std::move(rows)}};
}

/// Columns with names for those labels that have one.
void add_columns(const Cloud& cloud, View& view) {
  for (const auto& [name, column] : cloud.columns()) {
    auto shown = quantise(name, column);
    if (!shown) continue;
    if (shown->label) {
      if (name == column::kSensor)
        for (const Sensor& sensor : cloud.sensors()) shown->names.push_back(sensor.name);
      if (name == "grade") shown->names = {"good", "fair", "bad"};
    } else {
      view.histograms.push_back(histogram(name, shown->unit, numbers_of(column)));
    }
    view.columns.push_back(std::move(*shown));
  }
}

struct Maker {
  View& view;

  void operator()(const Cloud& cloud) const {
    quantise_positions(cloud, view);
    add_columns(cloud, view);
  }
  void operator()(const Mesh& mesh) const {
    (*this)(mesh.vertices());
    const auto triangles = mesh.triangles();
    std::vector<std::uint32_t> indices(static_cast<std::size_t>(triangles.size()));
    std::transform(triangles.data(), triangles.data() + triangles.size(), indices.begin(),
                   [](std::int32_t index) { return static_cast<std::uint32_t>(index); });
    set_triangles(view, indices);
    for (Histogram& each : triangle_histograms(mesh)) view.histograms.push_back(std::move(each));
  }
  void operator()(const Surface& surface) const {
    const Mesh mesh = sampled(surface);
    (*this)(mesh);
    // Those of the sampling say nothing of the surface.
    view.histograms.clear();
  }
  void operator()(const Transform& transform) const {
    view.matrix = Json::array();
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        view.matrix.push_back(transform.matrix.matrix()(row, column));
    if (!transform.history.headings().empty()) add_rows(transform.history, view);
  }
  void operator()(const Clusters& clusters) const {
    (*this)(clusters.cloud);
    std::vector<std::int64_t> numbers(static_cast<std::size_t>(clusters.labels.count()));
    const auto label = clusters.label();
    std::copy(label.begin(), label.end(), numbers.begin());
    std::erase_if(view.columns, [](const ViewColumn& each) { return each.name == "cluster"; });
    view.columns.insert(view.columns.begin(), labels("cluster", numbers));
    add_rows(clusters.kinds, view);
  }
  void operator()(const Correspondences& pairs) const {
    view.count = static_cast<std::uint64_t>(pairs.source.count());
    view.histograms.push_back(histogram("distance", "m", numbers_of(pairs.distance)));
    view.histograms.back().better = "lower";
  }
  void operator()(const Table& table) const {
    view.count = table.size();
    view.shown = rows_shown(table);
    add_rows(table, view);
  }
};

}  // namespace

View make_view(const Value& value) {
  View view;
  view.type = type_of(value);
  std::visit(Maker{view}, value);
  return view;
}

std::vector<std::uint32_t> indices_of(const View& view) {
  if (view.index_bits == 32) {
    const auto wide = view.triangles.as<std::uint32_t>();
    return {wide.begin(), wide.end()};
  }
  const auto narrow = view.triangles.as<std::uint16_t>();
  return {narrow.begin(), narrow.end()};
}

void set_triangles(View& view, const std::vector<std::uint32_t>& indices) {
  constexpr std::uint64_t kNarrow = 65536;
  view.index_bits = view.shown <= kNarrow ? 16 : 32;
  view.triangles = view.index_bits == 32
                       ? Bytes::of(indices)
                       : Bytes::of(std::vector<std::uint16_t>(indices.begin(), indices.end()));
}

}  // namespace velum::report
