// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/glb_scene.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

namespace velum::formats {
namespace {

using json = nlohmann::json;

class SceneWalk {
 public:
  explicit SceneWalk(const GlbDocument& document) : document_(document) {}

  std::vector<GlbInstance> walk() {
    const json& root = document_.root();
    const std::size_t scene = document_.whole(root, "scene", "scene").value_or(0);
    push_children(document_.entry("scenes", scene), "nodes", place_of("scenes", scene),
                  Eigen::Affine3d::Identity());
    while (!waiting_.empty()) {
      const Waiting next = waiting_.back();
      waiting_.pop_back();
      visit(next);
    }
    return std::move(instances_);
  }

 private:
  struct Waiting {
    std::size_t node = 0;
    Eigen::Affine3d parent;
  };

  /// The last one first, so that they are taken in order.
  void push_children(const json& object, const char* key, const std::string& place,
                     const Eigen::Affine3d& pose) {
    const auto children = object.find(key);
    if (children == object.end()) return;
    if (!children->is_array())
      throw document_.bad(place, fmt::format("'{}' is no list of nodes", key));
    for (auto child = children->rbegin(); child != children->rend(); ++child) {
      if (!child->is_number_unsigned())
        throw document_.bad(place, fmt::format("'{}' holds other than numbers of nodes", key));
      waiting_.push_back({child->get<std::size_t>(), pose});
    }
  }

  void visit(const Waiting& next) {
    const json& node = document_.entry("nodes", next.node);
    const std::string place = place_of("nodes", next.node);
    if (visited_.size() <= next.node) visited_.resize(next.node + 1, false);
    if (visited_[next.node])
      throw document_.bad(place, "the node is reached twice, expected a tree of nodes");
    visited_[next.node] = true;
    const Eigen::Affine3d pose = next.parent * pose_of(node, place);
    if (!pose.matrix().allFinite())
      throw document_.bad(place, "the node's transformation is not finite");
    if (const auto mesh = document_.whole(node, "mesh", place)) {
      if (node.contains("skin"))
        throw document_.bad(place,
                            "a mesh that moves with a skeleton ('skin'), expected a rigid "
                            "one");
      instances_.push_back({*mesh, pose});
    }
    push_children(node, "children", place, pose);
  }

  /// The node's own transformation: a matrix by columns, or translation, rotation and scale.
  [[nodiscard]] Eigen::Affine3d pose_of(const json& node, const std::string& place) const {
    Eigen::Affine3d pose = Eigen::Affine3d::Identity();
    if (node.contains("matrix")) {
      pose.matrix() = Eigen::Map<const Eigen::Matrix4d>(numbers<16>(node, "matrix", place).data());
      if (pose.matrix().row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))
        throw document_.bad(place, "the matrix's last row is not 0 0 0 1");
      return pose;
    }
    if (node.contains("translation"))
      pose.translation() = Eigen::Vector3d(numbers<3>(node, "translation", place).data());
    if (node.contains("rotation")) {
      const std::array<double, 4> q = numbers<4>(node, "rotation", place);
      const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
      constexpr double kSame = 1e-3;
      if (!(std::abs(turn.norm() - 1.0) < kSame))
        throw document_.bad(
            place, fmt::format("a rotation of length {}, expected a unit quaternion", turn.norm()));
      pose.linear() = turn.normalized().toRotationMatrix();
    }
    if (node.contains("scale"))
      pose.linear() *= Eigen::Vector3d(numbers<3>(node, "scale", place).data()).asDiagonal();
    return pose;
  }

  template <std::size_t N>
  [[nodiscard]] std::array<double, N> numbers(const json& node, const char* key,
                                              const std::string& place) const {
    const json& list = node.at(key);
    std::array<double, N> values{};
    bool good = list.is_array() && list.size() == N;
    for (std::size_t i = 0; good && i < N; ++i) {
      good = list[i].is_number();
      if (good) values[i] = list[i].template get<double>();
    }
    if (!good) throw document_.bad(place, fmt::format("'{}' is no list of {} numbers", key, N));
    return values;
  }

  const GlbDocument& document_;
  std::vector<Waiting> waiting_;
  std::vector<bool> visited_;
  std::vector<GlbInstance> instances_;
};

}  // namespace

std::vector<GlbInstance> instances_of(const GlbDocument& document) {
  return SceneWalk(document).walk();
}

}  // namespace velum::formats
