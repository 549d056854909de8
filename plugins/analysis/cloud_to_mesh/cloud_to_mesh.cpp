// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "deviation/statistics.hpp"
#include "deviation/surface.hpp"
#include "mesh/distance.hpp"

namespace {

using velum::Cloud;
using velum::Context;
using velum::Index;
using velum::Mesh;

// The mesh's normal, and the weights of its corners, at a place on triangle t. Corners have the
// normals of the triangles around them, weighted by area, so that normals do not jump at edges.
struct Place {
  Eigen::Vector3d normal;
  Eigen::Vector3d weights;
};

class Faces {
 public:
  explicit Faces(const Mesh& mesh)
      : positions_(mesh.positions().cast<double>()),
        triangles_(mesh.triangles()),
        corner_normals_(Eigen::Matrix3Xd::Zero(3, positions_.cols())) {
    for (Index t = 0; t < triangles_.cols(); ++t)
      for (int k = 0; k < 3; ++k) corner_normals_.col(triangles_(k, t)) += area(t);
  }

  [[nodiscard]] Place at(Index t, const Eigen::Vector3d& p) const {
    Place place;
    const Eigen::Vector3d flat = area(t);
    const double square = flat.squaredNorm();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d from = positions_.col(triangles_((k + 1) % 3, t));
      const Eigen::Vector3d to = positions_.col(triangles_((k + 2) % 3, t));
      place.weights[k] = square > 0.0 ? (to - from).cross(p - from).dot(flat) / square : 1.0 / 3.0;
    }
    place.normal.setZero();
    for (int k = 0; k < 3; ++k)
      place.normal += place.weights[k] * corner_normals_.col(triangles_(k, t)).normalized();
    // Around an edge as sharp as a knife's the corners' normals may cancel.
    if (place.normal.norm() < 0.1) place.normal = flat;
    place.normal.normalize();
    return place;
  }

 private:
  [[nodiscard]] Eigen::Vector3d area(Index t) const {
    const Eigen::Vector3d a = positions_.col(triangles_(0, t));
    return (positions_.col(triangles_(1, t)) - a).cross(positions_.col(triangles_(2, t)) - a);
  }

  Eigen::Matrix3Xd positions_;
  velum::ConstTriangles triangles_;
  Eigen::Matrix3Xd corner_normals_;
};

struct Compared {
  velum::deviation::Deviations found;
  Eigen::VectorXf height;
};

struct CloudToMesh {
  std::optional<velum::Length> radius;
  int bins = 20;
  std::optional<velum::Length> limit;

  static auto about() {
    return velum::About<CloudToMesh>(
               "Distance, normal deviation and curvature difference from each point to the nearest "
               "place of a mesh.")
        .in("cloud", "what is judged")
        .in("mesh", "what it should be")
        .out("table", "histograms")
        .out("cloud", "the input with a column for each deviation")
        .adds("cloud", "distance")
        .adds("cloud", "height")
        .adds("cloud", "normal_deviation")
        .adds("cloud", "curvature_difference")
        .param(&CloudToMesh::radius, "radius",
               "neighbourhood from which the cloud's normals and the curvature of cloud and "
               "vertices are made; unset: the columns that they have, or a neighbourhood chosen "
               "point by point",
               velum::above(0.0))
        .param(&CloudToMesh::bins, "bins", "ranges of each histogram", velum::between(1, 1000))
        .param(&CloudToMesh::limit, "limit",
               "end of the distances' histogram; unset: the greatest distance", velum::above(0.0))
        .deterministic()
        .reference("thesis 3.4, figure 3.51");
  }

  std::tuple<velum::Table, Cloud> operator()(const Cloud& cloud, const Mesh& mesh,
                                             Context& context) const {
    context.check();
    if (cloud.empty() || mesh.empty())
      throw velum::Error(velum::Fault::stage,
                         cloud.empty() ? "the cloud has no points" : "the mesh has no triangles");
    const std::optional<double> around = radius ? std::optional<double>(*radius) : std::nullopt;
    const Cloud own = velum::deviation::with_surface(cloud, around, context);
    context.progress(0.4);
    const Cloud vertices = velum::deviation::with_surface(mesh.vertices(), around, context);
    context.progress(0.7);
    const Compared compared = compare(own, mesh, vertices, context);
    const auto& found = compared.found;
    velum::Table table =
        velum::deviation::report_all(found, bins, limit ? limit->value : 0.0, context);
    context.measure("hausdorff", static_cast<double>(found.distance.maxCoeff()), "m",
                    velum::Better::lower);
    context.measure("height_mean", compared.height.cast<double>().mean(), "m");
    return {std::move(table), velum::deviation::with_columns(cloud, found)
                                  .with("height", velum::Column(compared.height))};
  }

 private:
  static Compared compare(const Cloud& cloud, const Mesh& mesh, const Cloud& vertices,
                          Context& context) {
    const velum::mesh::DistanceTree tree(mesh);
    const Faces faces(mesh);
    const auto triangles = mesh.triangles();
    const auto positions = cloud.positions();
    const auto bends = vertices.curvature();
    Compared compared{velum::deviation::Deviations(cloud.size()), Eigen::VectorXf(cloud.size())};
    velum::parallel_for(context, cloud.size(), 512, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        const Eigen::Vector3d p = positions.col(i).cast<double>();
        const auto hit = tree.closest(p);
        const Place place = faces.at(hit.triangle, hit.point);
        const double distance = std::sqrt(hit.distance2);
        double bend = 0.0;
        for (int k = 0; k < 3; ++k)
          bend += place.weights[k] * static_cast<double>(bends[triangles(k, hit.triangle)]);
        compared.found.distance[i] = static_cast<float>(distance);
        compared.height[i] =
            static_cast<float>((p - hit.point).dot(place.normal) < 0.0 ? -distance : distance);
        compared.found.normal[i] = static_cast<float>(
            velum::deviation::angle_between(cloud.normals().col(i).cast<double>(), place.normal));
        compared.found.curvature[i] = std::abs(cloud.curvature()[i] - static_cast<float>(bend));
      }
    });
    return compared;
  }
};

}  // namespace
VELUM_STAGE(CloudToMesh)
