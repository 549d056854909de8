// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fstream>

#include "own.hpp"

namespace bench {
namespace {

using velum::test::Stage;

Contender icp(const std::string& operation, int threads, const std::string& metric) {
  return {operation, threads == 1 ? "Velum, 1 thread" : "Velum", [=](const Input& input) {
            Stage stage("registration.icp");
            stage.set("metric", metric).set("iterations", "25").set("max_distance", "0.2 m");
            stage.set("relative_change", "0").threads(threads);
            return [stage, source = fresh(input.moved), target = fresh(input.normals)]() mutable {
              stage.run(source, target);
            };
          }};
}

Contender reader(const std::string& operation, const std::string& file) {
  return {operation, "Velum", [=](const Input& input) {
            Stage stage("io.read_cloud");
            stage.set("file", input.folder + "/" + file);
            return [stage]() mutable { stage.run(); };
          }};
}

/// What no reader can beat: the file's bytes into memory.
Contender file_read(const std::string& operation, const std::string& file) {
  return {operation, "bytes into memory", [=](const Input& input) {
            return [path = input.folder + "/" + file] {
              std::ifstream in(path, std::ios::binary | std::ios::ate);
              const auto size = static_cast<std::size_t>(in.tellg());
              const auto bytes = std::make_unique_for_overwrite<char[]>(size);
              in.seekg(0).read(bytes.get(), static_cast<std::streamsize>(size));
            };
          }};
}

}  // namespace

std::vector<Contender> ours() {
  std::vector<Contender> all;
  for (const int threads : {2, 1}) {
    all.push_back(stage("normals, k = 50", threads, &Input::cloud, [](const Input&) {
      return Stage("features.normals").set("neighbours", "50");
    }));
    all.push_back(stage("region growing, k = 50", threads, &Input::normals, [](const Input&) {
      return Stage("segmentation.region_growing")
          .set("neighbours", "50")
          .set("smoothness", "7 deg")
          .set("curvature", "0.05")
          .set("min_size", "1");
    }));
    all.push_back(stage("statistical outliers, k = 50", threads, &Input::cloud, [](const Input&) {
      return Stage("filtering.statistical_outliers").set("neighbours", "50").set("deviations", "2");
    }));
    all.push_back(stage("radius outliers", threads, &Input::cloud, [](const Input& input) {
      return Stage("filtering.radius_outliers")
          .set("radius", metres(input.radius))
          .set("min_neighbours", "10");
    }));
    all.push_back(stage("MLS, order 2", threads, &Input::cloud, [](const Input& input) {
      return Stage("resampling.mls").set("radius", metres(input.radius)).set("order", "2");
    }));
    all.push_back(stage("meshing", threads, &Input::smooth, [](const Input& input) {
      return Stage("meshing.delaunay_projected").set("max_edge", metres(4.0 * input.radius));
    }));
    all.push_back(icp("ICP point to point, 25 iterations", threads, "point_to_point"));
    all.push_back(icp("ICP point to plane, 25 iterations", threads, "point_to_plane"));
  }
  all.push_back(reader("read PCD, binary", "cloud.pcd"));
  all.push_back(reader("read PCD, ascii", "cloud_ascii.pcd"));
  all.push_back(reader("read PLY, binary", "cloud.ply"));
  all.push_back(file_read("read PCD, binary", "cloud.pcd"));
  all.push_back(file_read("read PCD, ascii", "cloud_ascii.pcd"));
  all.push_back(file_read("read PLY, binary", "cloud.ply"));
  return all;
}

}  // namespace bench
