// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>
#include <velum/testing.hpp>

#include "shapes/test_scene.hpp"

/// Scans that people labelled. They are no part of the project: nothing where VELUM_SHARED does not
/// have them.
namespace velum::test {

inline std::optional<Cloud> shared_cloud(const std::string& file) {
  const char* folder = std::getenv("VELUM_SHARED");  // NOLINT(concurrency-mt-unsafe)
  if (folder == nullptr) return std::nullopt;
  const auto path = std::filesystem::path(folder) / "data" / "segmentation" / file;
  if (!std::filesystem::exists(path)) return std::nullopt;
  return Stage("io.read_cloud").set("file", "\"" + path.string() + "\"").run().cloud();
}

inline Cloud every(const Cloud& cloud, std::int32_t step) {
  std::vector<std::int32_t> kept;
  for (std::int32_t i = 0; i < cloud.size(); i += step) kept.push_back(i);
  return cloud.select(kept);
}

/// A table with objects (mOSD "learn0", "learn36"), one point in `step`, with normals. Labels 1 to
/// 9 are parts of the table, 20 to 29 of the first object, and so on.
inline std::optional<Cloud> tabletop(const std::string& name, std::int32_t step = 5) {
  const auto scan = shared_cloud("mOSD/" + name + ".pcd");
  if (!scan) return std::nullopt;
  return Stage("features.normals").set("neighbours", "30").run(every(*scan, step)).cloud();
}

/// Ground seen from the air (ISPRS "samp11", ...) with normals: label 1 is ground, 0 is not.
inline std::optional<Cloud> terrain(const std::string& name) {
  const auto scan = shared_cloud("isprs/" + name + "-utm.pcd");
  const auto ground = shared_cloud("isprs/" + name + "-utm-ground.pcd");
  if (!scan || !ground) return std::nullopt;
  const Cloud truth = ground->with_origin(scan->origin());
  Eigen::VectorXi labels(scan->size());
  for (Index i = 0; i < scan->size(); ++i)
    labels[i] = truth.neighbours().nearest_one(scan->positions().col(i), 0.01).index >= 0 ? 1 : 0;
  return Stage("features.normals")
      .set("neighbours", "16")
      .run(scan->with("label", Column(std::move(labels))))
      .cloud();
}

/// The same cloud with one label in place of those from `first` to `last`.
inline Cloud joined_labels(const Cloud& cloud, int first, int last, int label) {
  Eigen::VectorXi labels = cloud.labels();
  for (int& one : labels)
    if (one >= first && one <= last) one = label;
  return cloud.with("label", Column(std::move(labels)));
}

}  // namespace velum::test
