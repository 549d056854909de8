// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "own.hpp"

namespace bench {
namespace {

Stage with_growing(Stage stage) {
  return stage.set("neighbours", "50")
      .set("smoothness", "7 deg")
      .set("curvature", "0.05")
      .set("min_size", "1");
}

Stage shapes(const std::string& id) {
  return Stage(id).set("model", "plane").set("epsilon", "0.02 m");
}

Stage six_planes(const std::string& id) {
  return shapes(id).set("shapes", "6");
}

}  // namespace

Contenders own_segmentation() {
  Contenders all;
  add_both(all, "region growing, k = 50", &Input::normals,
           [](const Input&) { return with_growing(Stage("segmentation.region_growing")); });
  all.push_back(on_cloud(
      "PCL's region growing wrapped, k = 50", &Input::normals,
      [](const Input&) { return with_growing(Stage("segmentation.pcl_region_growing")); }, kSlow));
  add_both(all, "Euclidean clusters of a room", &Input::scene, [](const Input& input) {
    return Stage("segmentation.euclidean").set("distance", metres(input.gap)).set("min_size", "10");
  });
  add_both(
      all, "RANSAC, six planes of a room", &Input::scene,
      [](const Input&) { return six_planes("segmentation.ransac"); }, kSlow);
  all.push_back(on_cloud(
      "PCL's RANSAC wrapped, six planes", &Input::scene,
      [](const Input&) { return six_planes("segmentation.pcl_ransac"); }, kSlow));
  all.push_back(on_cloud(
      "CGAL's RANSAC wrapped, planes", &Input::scene,
      [](const Input& input) {
        return shapes("segmentation.cgal_efficient_ransac").set("gap", metres(2.0 * input.gap));
      },
      kSlow));
  add_both(
      all, "Hough, six planes of a room", &Input::scene,
      [](const Input&) { return six_planes("segmentation.hough"); }, kSlow);
  return all;
}

}  // namespace bench
