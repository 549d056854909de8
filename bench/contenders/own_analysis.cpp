// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "own.hpp"

namespace bench {
namespace {

velum::Mesh mesh_of(const velum::Cloud& cloud) {
  return Stage("meshing.delaunay_projected").run(cloud).mesh();
}

Contender cloud_to_mesh(int threads) {
  Contender one = own("cloud to mesh", [=](const Input& input) {
    return [mesh = mesh_of(input.smooth), cloud = fresh(input.normals),
            stage = Stage("analysis.cloud_to_mesh").threads(threads)]() mutable {
      stage.run(cloud, mesh);
    };
  });
  if (threads == 1) one.name = "Velum, 1 thread";
  return one;
}

Contender mesh_to_reference() {
  return own("mesh to reference", [](const Input& input) {
    return [mesh = mesh_of(input.smooth), other = mesh_of(input.cloud),
            stage = Stage("analysis.mesh_to_reference")]() mutable { stage.run(mesh, other); };
  });
}

Contender on_mesh(const std::string& operation, const Make& make) {
  return own(operation, [=](const Input& input) {
    return [mesh = mesh_of(input.smooth), stage = make(input)]() mutable { stage.run(mesh); };
  });
}

Contender registration_error() {
  return own(
      "registration error",
      [](const Input&) {
        return [stage = Stage("analysis.registration_error")]() mutable {
          stage.run(velum::Transform(), velum::Transform());
        };
      },
      kSlowest);
}

Contender segmentation_score() {
  return own("score of a segmentation", [](const Input& input) {
    auto clusters = Stage("segmentation.euclidean")
                        .set("distance", metres(input.gap))
                        .run(input.scene)
                        .get<velum::Clusters>();
    return [clusters, stage = Stage("analysis.segmentation_score").set("label", "[11]")]() mutable {
      stage.run(clusters);
    };
  });
}

}  // namespace

Contenders own_analysis() {
  Contenders all;
  add_both(all, "cloud to cloud", &Input::moved, &Input::normals,
           [](const Input&) { return Stage("analysis.cloud_to_cloud"); });
  all.push_back(cloud_to_mesh(2));
  all.push_back(cloud_to_mesh(1));
  all.push_back(on_pair("displacement", &Input::smooth, &Input::normals,
                        [](const Input&) { return Stage("analysis.displacement"); }));
  all.push_back(
      on_mesh("mesh quality", [](const Input&) { return Stage("analysis.mesh_quality"); }));
  all.push_back(mesh_to_reference());
  all.push_back(on_mesh("sail shape", [](const Input&) {
    return Stage("analysis.sail_shape").set("bow", "[-1, 0, 0]");
  }));
  all.push_back(segmentation_score());
  all.push_back(registration_error());
  return all;
}

}  // namespace bench
