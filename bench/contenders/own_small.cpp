// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// The stages around the heavy ones: scanning, selecting, moving, writing, measuring.
#include <cmath>
#include <fstream>
#include <locale>

#include "own.hpp"

namespace bench {
namespace {

using velum::test::Stage;

const std::string kScene = VELUM_SOURCE_DIR "/graphs/scenes/wind_tunnel.toml";

/// A scan of the wind tunnel with about `points` points.
Stage scan(const std::string& scanner, velum::Index points) {
  constexpr double kStepDegrees = 0.25;
  constexpr double kPoints = 152'961.0;  // at that step
  const double step =
      std::max(kStepDegrees * std::sqrt(kPoints / static_cast<double>(points)), 0.0975);
  return Stage("devices.simulator")
      .set("scene", kScene)
      .set("scanner", scanner)
      .set("beam_step", std::to_string(step) + " deg")
      .set("tilt_step", std::to_string(step) + " deg");
}

Contender ours_as(const std::string& operation,
                  std::function<std::function<void()>(const Input&)> prepare) {
  return {operation, "Velum", std::move(prepare)};
}

/// A stage without threads of its own, on one cloud of the input.
Contender plain_stage(const std::string& operation, velum::Cloud Input::*cloud, const Make& make) {
  return stage(operation, 2, cloud, make);
}

Contender writer(const std::string& operation, const std::string& file) {
  return plain_stage(operation, &Input::cloud, [=](const Input& input) {
    return Stage("io.write_cloud").set("file", input.folder + "/out_" + file);
  });
}

Contender simulator() {
  return ours_as("simulate a scan", [](const Input& input) {
    return [stage = scan("gennaker", input.cloud.size())]() mutable { stage.run(); };
  });
}

Contender planes() {
  return ours_as("registration by planes", [](const Input& input) {
    const auto source = scan("mainsail", input.cloud.size()).run().cloud();
    const auto target = scan("gennaker", input.cloud.size()).run().cloud();
    return [source, target, stage = Stage("registration.planes")]() mutable {
      stage.run(source, target);
    };
  });
}

Contender svd() {
  return ours_as("SVD of 1,000 pairs", [](const Input& input) {
    const std::string file = input.folder + "/pairs.txt";
    std::ofstream out(file);
    out.imbue(std::locale::classic());
    for (velum::Index i = 0; i < 1000; ++i)
      out << input.cloud.positions().col(i).transpose() << ' '
          << input.moved.positions().col(i).transpose() << '\n';
    return [source = input.cloud, file] {
      Stage("registration.svd").set("file", file).set("units", "m").run(source);
    };
  });
}

Contender merged() {
  return ours_as("merge two clouds", [](const Input& input) {
    return [a = input.cloud, b = input.moved.without("normals").without("curvature")] {
      Stage("filtering.merge").in_many({a, b}).run();
    };
  });
}

Contender moved() {
  return plain_stage("move a cloud", &Input::normals, [](const Input&) {
    return Stage("filtering.transform").set("axis", "[1, 2, 3]").set("angle", "30 deg");
  });
}

Contender box() {
  return plain_stage("region of interest", &Input::cloud, [](const Input&) {
    return Stage("filtering.region_of_interest").set("min", "[0, -2, 1]").set("max", "[2, 2, 4]");
  });
}

Contender mesh_quality() {
  return ours_as("mesh quality", [](const Input& input) {
    const auto mesh = Stage("meshing.delaunay_projected").run(input.smooth).mesh();
    return [mesh] { Stage("analysis.mesh_quality").run(mesh); };
  });
}

Contender mesh_to_reference() {
  return ours_as("mesh to reference", [](const Input& input) {
    const auto mesh = Stage("meshing.delaunay_projected").run(input.smooth).mesh();
    const auto other = Stage("meshing.delaunay_projected").run(input.cloud).mesh();
    return [mesh, other] { Stage("analysis.mesh_to_reference").run(mesh, other); };
  });
}

Contender sail_shape() {
  return ours_as("sail shape", [](const Input& input) {
    const auto mesh = Stage("meshing.delaunay_projected").run(input.smooth).mesh();
    return [mesh] { Stage("analysis.sail_shape").set("bow", "[-1, 0, 0]").run(mesh); };
  });
}

}  // namespace

std::vector<Contender> our_small_ones() {
  return {simulator(),
          planes(),
          svd(),
          merged(),
          moved(),
          box(),
          writer("write PCD, binary", "cloud.pcd"),
          writer("write PLY, binary", "cloud.ply"),
          mesh_quality(),
          mesh_to_reference(),
          sail_shape()};
}

}  // namespace bench
