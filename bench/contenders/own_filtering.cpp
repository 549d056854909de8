// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "own.hpp"

namespace bench {
namespace {

velum::Clusters parts_of(const Input& input) {
  return Stage("segmentation.region_growing")
      .set("neighbours", "30")
      .set("smoothness", "7 deg")
      .set("min_size", "100")
      .run(input.scene)
      .get<velum::Clusters>();
}

Contender on_parts(const std::string& operation, const std::string& id) {
  return own(operation, [=](const Input& input) {
    return [parts = parts_of(input), stage = Stage(id)]() mutable { stage.run(parts); };
  });
}

Contender merged() {
  return own("merge two clouds", [](const Input& input) {
    return [a = input.cloud, b = input.moved.without("normals").without("curvature"),
            stage = Stage("filtering.merge")]() mutable {
      stage.in_many({a, b}).run();
    };
  });
}

void add_outliers(Contenders& all) {
  add_both(all, "statistical outliers, k = 50", &Input::cloud, [](const Input&) {
    return Stage("filtering.statistical_outliers").set("neighbours", "50").set("deviations", "2");
  });
  add_both(all, "radius outliers", &Input::cloud, [](const Input& input) {
    return Stage("filtering.radius_outliers")
        .set("radius", metres(input.radius))
        .set("min_neighbours", "10");
  });
  add_both(all, "mixed pixels of a scan", &Input::scene,
           [](const Input&) { return Stage("filtering.mixed_pixels"); });
}

}  // namespace

Contenders own_filtering() {
  Contenders all;
  add_outliers(all);
  add_both(all, "overlap of two clouds", &Input::cloud, &Input::moved, [](const Input& input) {
    return Stage("filtering.overlap").set("radius", metres(input.radius)).set("keep", "rest");
  });
  all.push_back(on_cloud("grazing incidence", &Input::scene,
                         [](const Input&) { return Stage("filtering.incidence"); }));
  all.push_back(on_cloud("region of interest", &Input::cloud, [](const Input&) {
    return Stage("filtering.region_of_interest").set("min", "[0, -2, 1]").set("max", "[2, 2, 4]");
  }));
  all.push_back(on_cloud("move a cloud", &Input::normals, [](const Input&) {
    return Stage("filtering.transform").set("axis", "[1, 2, 3]").set("angle", "30 deg");
  }));
  all.push_back(merged());
  all.push_back(on_cloud("remove picked points", &Input::cloud, [](const Input&) {
    return Stage("filtering.remove_points").set("points", "[[1, 0.2, 2]]").set("radius", "0.2 m");
  }));
  all.push_back(on_parts("select the largest cluster", "filtering.select_cluster"));
  all.push_back(on_parts("select the sails of a scene", "filtering.select_sail"));
  return all;
}

}  // namespace bench
