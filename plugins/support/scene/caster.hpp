// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "scene/scene.hpp"

namespace velum::scene {

struct Ray {
  Eigen::Vector3d from;
  Eigen::Vector3d along;  ///< unit length
};
/// The distances in which a ray looks for something.
struct Reach {
  double near = 0.0;
  double far = std::numeric_limits<double>::infinity();
};

/// Distance to the nearest point of a closed-form shape.
[[nodiscard]] std::optional<double> meet(const Plane& plane, const Ray& ray, const Reach& reach);
[[nodiscard]] std::optional<double> meet(const Box& box, const Ray& ray, const Reach& reach);
[[nodiscard]] std::optional<double> meet(const Ellipsoid& shape, const Ray& ray,
                                         const Reach& reach);
[[nodiscard]] std::optional<double> meet(const Cylinder& cylinder, const Ray& ray,
                                         const Reach& reach);
[[nodiscard]] std::optional<double> meet(const Cone& cone, const Ray& ray, const Reach& reach);

/// Unit normal of a closed-form shape at a point on it; its sign means nothing.
[[nodiscard]] Eigen::Vector3d normal(const Plane& plane, const Eigen::Vector3d& at);
[[nodiscard]] Eigen::Vector3d normal(const Box& box, const Eigen::Vector3d& at);
[[nodiscard]] Eigen::Vector3d normal(const Ellipsoid& shape, const Eigen::Vector3d& at);
[[nodiscard]] Eigen::Vector3d normal(const Cylinder& cylinder, const Eigen::Vector3d& at);
[[nodiscard]] Eigen::Vector3d normal(const Cone& cone, const Eigen::Vector3d& at);

/// Bounding volume hierarchy over triangles: nearest hit of a ray in logarithmic time.
class TriangleTree {
 public:
  struct Hit {
    double range;
    std::int32_t owner;
    std::int32_t triangle;
  };
  /// Takes the triangles of one owner; call build() when all are in.
  void add(const TriangleSet& set, std::int32_t owner);
  void build();
  [[nodiscard]] std::optional<Hit> meet(const Ray& ray, const Reach& reach) const;
  /// Unit normal of a triangle that was hit.
  [[nodiscard]] Eigen::Vector3d normal(std::int32_t triangle) const;

 private:
  struct Triangle {
    Eigen::Vector3d corner;
    Eigen::Vector3d first;  // edges from the corner
    Eigen::Vector3d second;
    std::int32_t owner;
    [[nodiscard]] Eigen::Vector3d centre() const { return corner + (first + second) / 3.0; }
  };
  // Inner nodes: children are the next node and `second`. Leaves: `count` triangles from `second`.
  struct Node {
    Eigen::AlignedBox3d box;
    std::int32_t second = 0;
    std::int32_t count = 0;
    int axis = 0;
  };
  void split(std::int32_t begin, std::int32_t end);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

/// Finds what a ray meets first in a scene. Immutable, so any number of threads may ask.
class Caster {
 public:
  struct Hit {
    double range;
    std::int32_t object;  ///< index into the scene's objects
    std::int32_t part;    ///< what of it: a number that incidence() understands
  };
  /// Sails are cut into triangles nowhere farther than 0.04 mm from them.
  explicit Caster(const Scene& scene);
  [[nodiscard]] std::optional<Hit> cast(const Ray& ray, const Reach& reach) const;
  /// Angle between a ray and the normal of what it hit [rad], 0 to π/2.
  [[nodiscard]] double incidence(const Ray& ray, const Hit& hit) const;

 private:
  template <class S>
  struct Placed {
    S shape;
    std::int32_t object;
  };
  using Solid =
      std::variant<Placed<Plane>, Placed<Box>, Placed<Ellipsoid>, Placed<Cylinder>, Placed<Cone>>;
  std::vector<Solid> solids_;
  TriangleTree tree_;
};

}  // namespace velum::scene
