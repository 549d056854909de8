// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include <algorithm>

#include "mesh/distance.hpp"

namespace {

using velum::Better;
using velum::Context;
using velum::Index;
using velum::Mesh;
using velum::Table;

/// Places on a mesh that stand for equal shares of it.
struct Samples {
  Eigen::Matrix3Xd points;
  Eigen::VectorXd weights;  ///< area that each stands for [m²]
};

double area_of(const Mesh& mesh) {
  const auto positions = mesh.positions();
  const auto triangles = mesh.triangles();
  double area = 0.0;
  for (Index t = 0; t < triangles.cols(); ++t) {
    const Eigen::Vector3d a = positions.col(triangles(0, t)).cast<double>();
    const Eigen::Vector3d ab = positions.col(triangles(1, t)).cast<double>() - a;
    const Eigen::Vector3d ac = positions.col(triangles(2, t)).cast<double>() - a;
    area += 0.5 * ab.cross(ac).norm();
  }
  return area;
}

/// Cuts every triangle into n² congruent ones with edges of at most `step` and takes their
/// centroids: the same places every time. Where that would be millions, steps are longer.
Samples sample(const Mesh& mesh, double area, double step) {
  const auto positions = mesh.positions();
  const auto triangles = mesh.triangles();
  constexpr double kMostSamples = 2e6;
  constexpr double kMostCuts = 1000.0;
  step = std::max(step, std::sqrt(2.0 * area / kMostSamples));
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (Index t = 0; t < triangles.cols(); ++t) {
    const Eigen::Vector3d a = positions.col(triangles(0, t)).cast<double>();
    const Eigen::Vector3d ab = positions.col(triangles(1, t)).cast<double>() - a;
    const Eigen::Vector3d ac = positions.col(triangles(2, t)).cast<double>() - a;
    const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
    const double cuts = step > 0.0 ? std::ceil(longest / step) : 1.0;
    const int n = static_cast<int>(std::clamp(cuts, 1.0, kMostCuts));
    const double weight = 0.5 * ab.cross(ac).norm() / (n * n);
    const auto add = [&](double u, double v) {
      points.push_back(a + u / n * ab + v / n * ac);
      weights.push_back(weight);
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        add(i + 1.0 / 3.0, j + 1.0 / 3.0);
        if (i + j + 1 < n) add(i + 2.0 / 3.0, j + 2.0 / 3.0);
      }
    }
  }
  Samples samples;
  samples.points.resize(3, static_cast<Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    samples.points.col(static_cast<Index>(i)) = points[i];
  samples.weights = Eigen::Map<const Eigen::VectorXd>(weights.data(), samples.points.cols());
  return samples;
}

struct Deviation {
  double rms = 0.0, mean = 0.0, p95 = 0.0, max = 0.0;
};

Eigen::VectorXd distances(const Eigen::Matrix3Xd& from, const velum::mesh::DistanceTree& to,
                          Context& context) {
  Eigen::VectorXd found(from.cols());
  velum::parallel_for(context, from.cols(), 1024, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) found[i] = std::sqrt(to.closest(from.col(i)).distance2);
  });
  return found;
}

/// Area-weighted figures of the samples; the greatest distance is over samples and vertices.
Deviation deviation(const Mesh& from, const velum::mesh::DistanceTree& to, double step,
                    Context& context) {
  const double area = area_of(from);
  if (!(area > 0.0))
    throw velum::Error(velum::Fault::stage, "a mesh without area cannot be compared");
  const Samples samples = sample(from, area, step);
  const Eigen::VectorXd d = distances(samples.points, to, context);
  const Eigen::VectorXd at_vertices = distances(from.positions().cast<double>(), to, context);
  Deviation result;
  result.mean = samples.weights.dot(d) / area;
  result.rms = std::sqrt(samples.weights.dot(d.cwiseAbs2()) / area);
  result.max = std::max(d.maxCoeff(), at_vertices.maxCoeff());
  std::vector<Index> order(static_cast<std::size_t>(d.size()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return std::pair(d[a], a) < std::pair(d[b], b); });
  double covered = 0.0;
  for (const Index i : order) {
    covered += samples.weights[i];
    result.p95 = d[i];
    if (covered >= 0.95 * area) break;
  }
  return result;
}

struct MeshToReference {
  velum::Length step = velum::diagonals(0.004);

  static auto about() {
    return velum::About<MeshToReference>(
               "Distances between a mesh and a reference, both ways, weighted by area.")
        .in("mesh", "what is judged")
        .in("reference", "what it should be")
        .out("table", "one row a direction")
        .param(&MeshToReference::step, "step",
               "triangles are sampled at least this closely; relative to the mesh",
               velum::at_least(0.0))
        .advanced()
        .reference(
            "Cignoni, Rocchini and Scopigno, Metro: measuring error on simplified surfaces, "
            "Computer Graphics Forum 17 (1998)");
  }

  Table operator()(const Mesh& mesh, const Mesh& reference, Context& context) const {
    context.check();
    if (mesh.empty() || reference.empty())
      throw velum::Error(velum::Fault::stage,
                         std::string(mesh.empty() ? "the mesh" : "the reference") +
                             " has no triangles: there is no distance");
    const velum::mesh::DistanceTree mesh_tree(mesh);
    const velum::mesh::DistanceTree reference_tree(reference);
    const Deviation forward = deviation(mesh, reference_tree, step, context);
    context.progress(0.5);
    const Deviation back = deviation(reference, mesh_tree, step, context);

    context.measure("rms", forward.rms, "m", Better::lower);
    context.measure("mean", forward.mean, "m", Better::lower);
    context.measure("p95", forward.p95, "m", Better::lower);
    context.measure("hausdorff", std::max(forward.max, back.max), "m", Better::lower);
    context.measure("max", forward.max, "m", Better::lower);
    context.measure("back_rms", back.rms, "m", Better::lower);
    context.measure("back_mean", back.mean, "m", Better::lower);
    context.measure("back_p95", back.p95, "m", Better::lower);
    context.measure("back_max", back.max, "m", Better::lower);
    Table table({{"direction", ""}, {"rms", "m"}, {"mean", "m"}, {"p95", "m"}, {"max", "m"}});
    table.add(
        {std::string("mesh to reference"), forward.rms, forward.mean, forward.p95, forward.max});
    table.add({std::string("reference to mesh"), back.rms, back.mean, back.p95, back.max});
    return table;
  }
};

}  // namespace
VELUM_STAGE(MeshToReference)
