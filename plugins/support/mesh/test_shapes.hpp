// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <velum/testing.hpp>

/// What the tests of meshers share: shapes whose surface is known, and what a mesh of them is like.
namespace velum::mesh::test {

using velum::test::Stage;

/// n × n points over the unit square, height by `z`, seen from `sensor_height` above its middle.
template <class Height>
Cloud grid(int n, const Height& z, double sensor_height = 5.0) {
  Points points(3, n * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = i / (n - 1.0);
      const double y = j / (n - 1.0);
      points.col(i * n + j) = Eigen::Vector3d(x, y, z(x, y)).cast<float>();
    }
  Pose pose = Pose::Identity();
  pose.translation() << 0.5, 0.5, sensor_height;
  return Cloud(std::move(points)).with_sensors({{"scanner", pose}});
}

inline Cloud flat(int n) {
  return grid(n, [](double, double) { return 0.0; });
}

/// A sheet bent along both axes, in general position: no four of its points lie on a circle.
inline Cloud bent(int n, double noise = 0.0) {
  Random random(7);
  return grid(n, [&](double x, double y) {
    return 0.3 * x * x - 0.2 * x * y + 0.1 * std::sin(3.0 * y) + noise * random.gaussian();
  });
}

/// Points spread evenly over the sphere of radius 1 (Fibonacci's spiral), normals outwards.
inline Cloud sphere(int count) {
  Points points(3, count);
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double angle = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;
    const double r = std::sqrt(1.0 - z * z);
    points.col(i) = Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z).cast<float>();
  }
  return Cloud(points).with(column::kNormals, Column(points));
}

inline Cloud with_normals(const Cloud& cloud) {
  return Stage("features.normals").run(cloud).cloud();
}

struct Quality {
  double holes, loops, manifold, border, area, parts;
};
inline Quality quality(const Mesh& mesh) {
  const auto out = Stage("analysis.mesh_quality").run(mesh);
  return {out.measure("holes"),         out.measure("loops"), out.measure("manifold"),
          out.measure("border_length"), out.measure("area"),  out.measure("parts")};
}

inline velum::test::Outcome deviation(const Mesh& mesh, const Mesh& reference) {
  return Stage("analysis.mesh_to_reference").run(mesh, reference);
}

/// The gennaker of the wind tunnel as its scanner sees it, with the measured noise, cut from the
/// scene and smoothed; and what it truly is.
struct Sail {
  Cloud cloud;
  Mesh truth;
};
inline const Sail& sail() {
  static const Sail made = [] {
    const std::string scene = VELUM_SOURCE_DIR "/graphs/scenes/wind_tunnel.toml";
    const Cloud scan =
        Stage("devices.simulator").set("scene", scene).set("scanner", "gennaker").run().cloud();
    const Cloud rig = Stage("filtering.region_of_interest")
                          .set("min", "[-2.5, 0.8, -0.9]")
                          .set("max", "[2.5, 5.5, 1.15]")
                          .run(scan)
                          .cloud();
    const auto parts = Stage("segmentation.region_growing")
                           .set("neighbours", "15")
                           .set("smoothness", "7 deg")
                           .set("min_size", "500")
                           .run(with_normals(rig));
    const Cloud found = Stage("filtering.select_cluster").run(parts.get<Clusters>()).cloud();
    const auto truth = Stage("devices.truth")
                           .set("scene", scene)
                           .set("object", "gennaker")
                           .set("frame", "gennaker")
                           .run();
    return Sail{Stage("resampling.mls").set("radius", "0.1 m").run(found).cloud(), truth.mesh()};
  }();
  return made;
}

/// Do the triangles look at the sensor of the cloud, all but a share?
inline double share_towards_sensor(const Mesh& mesh) {
  const auto t = mesh.triangles();
  const auto p = mesh.positions();
  Index towards = 0;
  for (Index i = 0; i < t.cols(); ++i) {
    const Eigen::Vector3f a = p.col(t(0, i));
    const Eigen::Vector3f normal = (p.col(t(1, i)) - a).cross(p.col(t(2, i)) - a);
    towards += normal.dot(mesh.vertices().sensor_position(0) - a) > 0.0F ? 1 : 0;
  }
  return static_cast<double>(towards) / static_cast<double>(std::max<Index>(t.cols(), 1));
}

}  // namespace velum::mesh::test
