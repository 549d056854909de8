// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scene/error_model.hpp"
#include "scene/material.hpp"
#include "scene/sail.hpp"

namespace velum::scene {

/// A rectangle, or the whole plane where the halves are infinite.
struct Plane {
  Pose pose = Pose::Identity();  ///< x and y along the sides, z the normal
  double half_x = std::numeric_limits<double>::infinity();
  double half_y = std::numeric_limits<double>::infinity();
};
struct Box {
  Pose pose = Pose::Identity();
  Eigen::Vector3d half = Eigen::Vector3d::Ones();
};
struct Ellipsoid {
  Pose pose = Pose::Identity();
  Eigen::Vector3d semi_axes = Eigen::Vector3d::Ones();
};
/// With flat ends.
struct Cylinder {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::UnitZ();
  double radius = 1.0;
};
/// With a flat base.
struct Cone {
  Eigen::Vector3d apex = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d base = Eigen::Vector3d::Zero();  ///< centre of the base
  double radius = 1.0;                             ///< of the base
};
struct TriangleSet {
  Eigen::Matrix3Xd vertices;
  Triangles triangles;
};
using Shape = std::variant<Plane, Box, Ellipsoid, Cylinder, Cone, TriangleSet, Sail>;

/// A named part of a scene: one or several shapes under one label.
struct Object {
  std::string name;
  std::int32_t label = 0;
  std::vector<Shape> shapes;
  std::optional<Material> material = std::nullopt;
  /// The sail when it is one, else null.
  [[nodiscard]] const Sail* sail() const;
};

/// A line scanner on a tilt plate. Its frame: x to the right, y ahead, z up. A beam at angle φ of a
/// line at tilt τ runs along (cos φ, sin φ cos τ, sin φ sin τ): the plate turns about x. Defaults
/// are those of the SICK LMS 511 (thesis 2.3.1).
struct Scanner {
  std::string name;
  Pose pose = Pose::Identity();  ///< scanner's frame → scene
  double beam_from = -5.0 * 0.017453292519943295;
  double beam_to = 185.0 * 0.017453292519943295;
  double beam_step = 0.25 * 0.017453292519943295;
  double tilt_from = -45.0 * 0.017453292519943295;
  double tilt_to = 45.0 * 0.017453292519943295;
  double tilt_step = 0.25 * 0.017453292519943295;
  double noise = 0.004;     ///< standard deviation of a range [m] (thesis 2.4.3.2)
  Effects effects;          ///< what else acts on ranges
  int repeats = 1;          ///< lines at each tilt
  double period = 0.0;      ///< time from line to line [s]; 0: not known
  double range_min = 0.2;   ///< [m]
  double range_max = 80.0;  ///< [m]
};

/// Light that disturbs a scanner which looks towards it.
struct Sun {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< towards it, in the scene's frame
  double width = 5.0 * 0.017453292519943295;             ///< of its glare, one sigma [rad]
};

/// What there is to be seen, and from where.
struct Scene {
  std::string path;
  std::string title;
  std::vector<Object> objects;
  std::vector<Scanner> scanners;
  std::optional<Sun> sun;

  /// Throws Error (Fault::graph) naming what the scene has.
  [[nodiscard]] const Object& object(std::string_view name) const;
  [[nodiscard]] const Scanner& scanner(std::string_view name) const;
};

/// Reads a scene. Throws Error (Fault::input) with file, line and column.
[[nodiscard]] Scene read_scene(const std::filesystem::path& path);
/// The same from text; `path` is what messages call it and where the scene's own files are found.
[[nodiscard]] Scene parse_scene(std::string_view text, const std::filesystem::path& path);

/// For a stage's check(): does the scene have a scanner, or an object, of that name? Throws Error
/// (Fault::graph) at `parameter` when it does not. A scene that cannot be read is left to the run,
/// which says why.
void require_scanner(const std::filesystem::path& scene, std::string_view name,
                     const char* parameter);
void require_object(const std::filesystem::path& scene, std::string_view name,
                    const char* parameter);

/// Triangles on the object's surface, nowhere farther than `error` [m] from it. Throws Error for an
/// infinite plane.
[[nodiscard]] TriangleSet triangulate(const Object& object, double error);

}  // namespace velum::scene
