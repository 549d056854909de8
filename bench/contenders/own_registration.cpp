// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fstream>
#include <locale>

#include "own.hpp"

namespace bench {
namespace {

Make icp(const std::string& metric, const std::string& kernel = "none") {
  return [=](const Input&) {
    return Stage("registration.icp")
        .set("metric", metric)
        .set("kernel", kernel)
        .set("iterations", "25")
        .set("max_distance", "0.2 m")
        .set("relative_change", "0");
  };
}

Contender borrowed(const std::string& operation, const Make& make, velum::Index max_points = 0) {
  return on_pair(operation, &Input::moved, &Input::normals, make, max_points);
}

void add_icps(Contenders& all) {
  const auto add = [&](const std::string& name, const Make& make) {
    add_both(all, "ICP " + name + ", 25 iterations", &Input::moved, &Input::normals, make);
  };
  add("point to point", icp("point_to_point"));
  add("point to plane", icp("point_to_plane"));
  add("symmetric", icp("symmetric"));
  add("point to plane, Tukey", icp("point_to_plane", "tukey"));
}

void add_pcls(Contenders& all) {
  all.push_back(borrowed(
      "PCL's ICP wrapped, 10 iterations",
      [](const Input&) {
        return Stage("registration.pcl_icp")
            .set("iterations", "10")
            .set("max_distance", "0.2 m")
            .set("relative_change", "0");
      },
      kSlow));
  all.push_back(borrowed(
      "PCL's GICP wrapped, 5 iterations",
      [](const Input&) {
        return Stage("registration.pcl_gicp").set("iterations", "5").set("max_distance", "0.2 m");
      },
      kSlowest));
  all.push_back(borrowed(
      "PCL's NDT wrapped, 10 iterations",
      [](const Input&) {
        return Stage("registration.pcl_ndt")
            .set("iterations", "10")
            .set("cell", "0.4 m")
            .set("step", "0.05 m")
            .set("still_shift", "1e-6 m");
      },
      kSlow));
}

Contender svd() {
  return own("SVD of 1,000 pairs", [](const Input& input) {
    const std::string file = input.folder + "/pairs.txt";
    std::ofstream out(file);
    out.imbue(std::locale::classic());
    for (velum::Index i = 0; i < 1000; ++i)
      out << input.cloud.positions().col(i).transpose() << ' '
          << input.moved.positions().col(i).transpose() << '\n';
    return [source = input.cloud,
            stage = Stage("registration.svd").set("file", file).set("units", "m")]() mutable {
      stage.run(source);
    };
  });
}

}  // namespace

Contenders own_registration() {
  Contenders all;
  add_icps(all);
  add_pcls(all);
  add_both(
      all, "global, by features, of a room", &Input::other, &Input::scene,
      [](const Input&) { return Stage("registration.global").set("planes", "false"); }, kSlow);
  all.push_back(on_pair(
      "by point feature histograms", &Input::moved, &Input::cloud,
      [](const Input&) { return Stage("registration.pfh_icp"); }, kSlowest));
  all.push_back(on_pair("by planes, any start", &Input::other, &Input::scene,
                        [](const Input&) { return Stage("registration.planes"); }));
  all.push_back(svd());
  return all;
}

}  // namespace bench
