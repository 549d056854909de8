// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "testing/sound.hpp"

#include <fmt/format.h>

#include <cmath>

namespace velum::test {
namespace {

bool finite(const auto& matrix) {
  return matrix.array().isFinite().all();
}

struct Unsound {
  std::string operator()(const Cloud& cloud) const {
    if (!finite(cloud.positions())) return "a position that is not finite";
    if (!finite(cloud.origin())) return "an origin that is not finite";
    for (const auto& [name, column] : cloud.columns())
      if (column.count() != cloud.size())
        return fmt::format("column '{}' with {} entries for {} points", name, column.count(),
                           cloud.size());
    for (const Sensor& sensor : cloud.sensors())
      if (const auto fault = rigid(sensor.pose); !fault.empty())
        return "a sensor whose pose " + fault;
    return known_columns(cloud);
  }

  std::string operator()(const Mesh& mesh) const {
    if (mesh.size() > 0) {
      const auto triangles = mesh.triangles();
      if (triangles.minCoeff() < 0 || triangles.maxCoeff() >= mesh.vertices().size())
        return "a triangle of a vertex that does not exist";
    }
    return (*this)(mesh.vertices());
  }

  std::string operator()(const Surface& surface) const {
    const Index u = surface.knots_u.size() - surface.degree_u - 1;
    const Index v = surface.knots_v.size() - surface.degree_v - 1;
    if (surface.degree_u < 1 || surface.degree_v < 1) return "a degree below 1";
    if (u <= surface.degree_u || v <= surface.degree_v || u * v != surface.control.cols())
      return "knots that do not fit the control points";
    if (surface.weights.size() != 0 && surface.weights.size() != surface.control.cols())
      return "weights that do not fit the control points";
    if (surface.weights.size() != 0 && !(surface.weights.array() > 0.0).all())
      return "a weight that is not positive";
    if (!finite(surface.control)) return "a control point that is not finite";
    if (!ascending(surface.knots_u) || !ascending(surface.knots_v))
      return "knots that do not ascend";
    return "";
  }

  std::string operator()(const Transform& transform) const {
    const auto fault = rigid(transform.matrix);
    if (!fault.empty()) return "a motion that " + fault;
    return std::isfinite(transform.fitness) ? "" : "a fitness that is not finite";
  }

  std::string operator()(const Clusters& clusters) const {
    const auto labels = clusters.label();
    if (labels.size() != clusters.cloud.size()) return "labels that do not fit the points";
    if (labels.size() > 0 && labels.minCoeff() < -1) return "a label below -1";
    if (labels.size() > 0 && labels.maxCoeff() >= static_cast<Index>(clusters.kinds.size()))
      return "a label without a row in the table of clusters";
    return (*this)(clusters.cloud);
  }

  std::string operator()(const Correspondences& pairs) const {
    const Index count = pairs.source.count();
    if (pairs.target.count() != count || pairs.distance.count() != count)
      return "pairs of unequal number";
    if (count == 0) return "";
    if (pairs.source.vector<int>().minCoeff() < 0 || pairs.target.vector<int>().minCoeff() < 0)
      return "a pair with a negative index";
    const auto distance = pairs.distance.vector<float>();
    return finite(distance) && distance.minCoeff() >= 0.0F ? "" : "a distance that is none";
  }

  std::string operator()(const Table& table) const {
    for (const auto& row : table.rows())
      if (row.size() != table.headings().size()) return "a row that does not fit the headings";
    return "";
  }

 private:
  static std::string known_columns(const Cloud& cloud) {
    if (cloud.has(column::kNormals) && cloud.size() > 0) {
      const auto normals = cloud.normals();
      if (!finite(normals)) return "a normal that is not finite";
      constexpr float kTolerance = 1e-3F;
      if (!((normals.colwise().norm().array() - 1.0F).abs() < kTolerance).all())
        return "a normal that is not of unit length";
    }
    if (cloud.has(column::kCurvature) && cloud.size() > 0) {
      const auto curvature = cloud.curvature();
      constexpr float kMost = 1.0F / 3.0F + 1e-4F;
      if (!(curvature.array() >= 0.0F && curvature.array() <= kMost).all())
        return "a curvature outside 0 to 1/3";
    }
    if (cloud.has(column::kSensor) && cloud.size() > 0 && !cloud.sensors().empty()) {
      const auto sensor = cloud.column(column::kSensor).vector<std::uint8_t>();
      if (sensor.maxCoeff() >= cloud.sensors().size()) return "a sensor number without a sensor";
    }
    return "";
  }

  static std::string rigid(const Pose& pose) {
    if (!finite(pose.matrix())) return "is not finite";
    const Eigen::Matrix3d r = pose.linear();
    constexpr double kTolerance = 1e-6;
    if ((r.transpose() * r - Eigen::Matrix3d::Identity()).norm() > kTolerance ||
        r.determinant() < 0.0)
      return "is no rotation and translation";
    return "";
  }

  static bool ascending(const Eigen::VectorXd& knots) {
    if (!finite(knots)) return false;
    for (Index i = 1; i < knots.size(); ++i)
      if (knots[i] < knots[i - 1]) return false;
    return true;
  }
};

}  // namespace

std::string unsound(const Value& value) {
  return std::visit(Unsound{}, value);
}

}  // namespace velum::test
