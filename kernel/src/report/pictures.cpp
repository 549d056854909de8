// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "report/pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

#include "graph/graph.hpp"
#include "picture/drawing.hpp"
#include "report/quantise.hpp"
#include "report/surface_mesh.hpp"
#include "run/summary.hpp"

namespace velum::report {
namespace {

namespace fs = std::filesystem;

/// Columns that say most of a cloud, the first that it has colours it; else its height.
constexpr std::array<std::string_view, 5> kTelling = {"displacement", "distance", "cluster",
                                                      "normal_deviation", "incidence"};

bool is_whole(const Column& column) {
  return column.scalar() == Scalar::u8 || column.scalar() == Scalar::i32;
}

const Column* column_for(const Cloud& cloud, const std::string& wanted) {
  const auto usable = [&](std::string_view name) -> const Column* {
    if (!cloud.has(name) || cloud.column(name).width() != 1) return nullptr;
    return &cloud.column(name);
  };
  if (!wanted.empty()) return wanted == "height" ? nullptr : usable(wanted);
  for (const std::string_view name : kTelling)
    if (const Column* column = usable(name)) return column;
  return nullptr;
}

std::string name_of(const Cloud& cloud, const Column& column) {
  for (const auto& [name, each] : cloud.columns())
    if (&each == &column) return name;
  return "";
}

picture::Colouring colouring_of(const Cloud& cloud, const std::string& wanted) {
  if (const Column* column = column_for(cloud, wanted)) {
    const std::string name = name_of(cloud, *column);
    return {.name = name,
            .unit = unit_of(name),
            .numbers = numbers_of(*column),
            .labels = is_whole(*column)};
  }
  picture::Colouring height{.name = "height", .unit = "m", .numbers = {}, .labels = false};
  const auto positions = cloud.positions();
  for (Index i = 0; i < positions.cols(); ++i)
    height.numbers.push_back(static_cast<double>(positions(2, i)) + cloud.origin().z());
  return height;
}

picture::Shape shape_of(const Cloud& cloud, const std::string& colour) {
  picture::Shape shape{.positions = cloud.positions()};
  for (std::size_t i = 0; i < cloud.sensors().size(); ++i)
    shape.eyes.push_back(cloud.sensor_position(i));
  shape.colouring = colouring_of(cloud, colour);
  return shape;
}

}  // namespace

bool draw_value(const Value& value, const std::string& title, const std::string& colour,
                const fs::path& file) {
  std::optional<picture::Shape> shape;
  Mesh mesh;
  if (const auto* cloud = std::get_if<Cloud>(&value)) {
    shape.emplace(shape_of(*cloud, colour));
  } else if (const auto* clusters = std::get_if<Clusters>(&value)) {
    shape.emplace(shape_of(clusters->cloud, colour));
    if (colour.empty() || colour == "cluster")
      shape->colouring = {
          .name = "cluster", .unit = "", .numbers = numbers_of(clusters->labels), .labels = true};
  } else if (const auto* given = std::get_if<Mesh>(&value)) {
    mesh = *given;
  } else if (const auto* surface = std::get_if<Surface>(&value)) {
    mesh = sampled(*surface);
  } else {
    return false;
  }
  if (!shape) {
    shape.emplace(shape_of(mesh.vertices(), colour));
    shape->triangles.emplace(mesh.triangles());
  }
  shape->title = title;
  shape->subtitle = run::in_words(run::summarise(value));
  picture::write_png(picture::draw(*shape), file);
  return true;
}

PictureWatch::PictureWatch(fs::path folder, std::string colour)
    : folder_(std::move(folder)), colour_(std::move(colour)) {
  std::error_code failed;
  fs::create_directories(folder_, failed);
  if (!fs::is_directory(folder_))
    throw Error(Fault::output,
                failed ? "the folder cannot be made: " + failed.message() : "not a folder")
        .at(folder_.string())
        .hint("choose another folder with --png");
}

bool PictureWatch::wants(const graph::Node& node) const {
  return std::ranges::any_of(node.info->outputs, [](const Port& port) {
    return std::ranges::any_of(port.types, [](ValueType type) {
      return type == ValueType::cloud || type == ValueType::mesh || type == ValueType::surface ||
             type == ValueType::clusters;
    });
  });
}

void PictureWatch::made(const graph::Node& node, const std::vector<Wired>& /*inputs*/,
                        const Results& results) {
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i]) continue;
    const std::string name = node.name + "." + node.info->outputs[i].name;
    std::optional<Error> problem;
    bool drawn = false;
    try {
      drawn = draw_value(*results[i], name, colour_, folder_ / (name + ".png"));
    } catch (const Error& error) {
      problem = error;
    } catch (const std::exception& error) {
      problem = Error(Fault::output, std::string("the picture cannot be made: ") + error.what())
                    .at(name + ".png");
    }
    const std::lock_guard lock(mutex_);
    if (drawn) ++count_;
    if (problem && !failed_) failed_ = problem;
  }
}

std::optional<Error> PictureWatch::failed() const {
  const std::lock_guard lock(mutex_);
  return failed_;
}

std::size_t PictureWatch::count() const {
  const std::lock_guard lock(mutex_);
  return count_;
}

}  // namespace velum::report
