// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include <algorithm>
#include <numbers>
#include <tuple>

#include "scene/scene.hpp"
#include "scene/surface.hpp"

namespace {

using velum::scene::Object;
using velum::scene::Sail;
using velum::scene::Scene;

constexpr double kMeshError = 5e-5;  // [m]

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

velum::Mesh mesh_of(const Object& object, const velum::Pose& motion) {
  velum::scene::TriangleSet set = velum::scene::triangulate(object, kMeshError);
  // About an origin of its own, so that single precision costs nothing far from the frame's.
  const Eigen::Vector3d origin = (motion * set.vertices.col(0)).array().round();
  velum::Points points(3, set.vertices.cols());
  for (velum::Index i = 0; i < points.cols(); ++i)
    points.col(i) = (motion * set.vertices.col(i) - origin).cast<float>();
  return {velum::Cloud(std::move(points), origin), std::move(set.triangles)};
}

// Angles are relative to the lowest of `heights`, as those that analysis.sail_shape measures.
velum::Table table_of(const Sail& sail, const velum::Pose& motion,
                      const std::vector<double>& heights) {
  velum::Table table({{"height", ""},
                      {"z", "m"},
                      {"chord", "m"},
                      {"camber", "%"},
                      {"draft", "%"},
                      {"twist", "deg"},
                      {"entry", "deg"},
                      {"exit", "deg"}});
  const Eigen::Vector3d up = motion.linear() * sail.design().up;
  const double base = sail.section(*std::min_element(heights.begin(), heights.end())).angle;
  for (const double height : heights) {
    const auto section = sail.section(height);
    table.add({height, (motion * sail.at(0.0, height)).dot(up), section.chord,
               100.0 * section.camber, 100.0 * section.draft, degrees(section.angle - base),
               degrees(section.entry), degrees(section.exit)});
  }
  return table;
}

void report(const Sail& sail, velum::Context& context) {
  context.measure("luff", sail.luff(), "m");
  context.measure("leech", sail.leech(), "m");
  context.measure("foot", sail.foot(), "m");
  context.measure("area", sail.area(), "m^2");
}

struct Truth {
  velum::InputFile scene;
  std::optional<std::string> object;
  std::optional<std::string> scanner;
  std::optional<std::string> frame;
  std::vector<double> heights{0.25, 0.5, 0.75};

  using Known = std::tuple<std::optional<velum::Mesh>, std::optional<velum::Surface>,
                           std::optional<velum::Transform>, std::optional<velum::Table>>;

  static auto about() {
    return velum::About<Truth>("What a scene knows of an object or of a scanner.")
        .out("mesh", "of an object")
        .out("surface", "of a sail, bicubic")
        .out("transform", "of a scanner: its frame to `frame`")
        .out("table", "sections of a sail")
        .param(&Truth::scene, "scene", "the scene, a TOML file")
        .required()
        .param(&Truth::object, "object", "name of the object that is asked for")
        .param(&Truth::scanner, "scanner", "name of the scanner that is asked for")
        .param(&Truth::frame, "frame",
               "the scanner in whose frame the answer is; else it is in the scene's")
        .param(&Truth::heights, "heights",
               "of the sections, as shares of the way from tack to head", velum::between(0.0, 1.0))
        .deterministic();
  }

  void check() const {
    if (object.has_value() == scanner.has_value())
      throw velum::Error(velum::Fault::graph, "either 'object' or 'scanner' must be given")
          .at("scanner");
    if (object) velum::scene::require_object(scene.path, *object, "object");
    if (scanner) velum::scene::require_scanner(scene.path, *scanner, "scanner");
    if (frame) velum::scene::require_scanner(scene.path, *frame, "frame");
    if (heights.empty())
      throw velum::Error(velum::Fault::graph, "'heights' is empty").at("heights");
  }

  Known operator()(velum::Context& context) const {
    const Scene read = velum::scene::read_scene(scene.path);
    velum::Pose motion = velum::Pose::Identity();
    if (frame) motion = read.scanner(*frame).pose.inverse();
    Known known;
    if (scanner) {
      velum::Transform transform;
      transform.matrix = motion * read.scanner(*scanner).pose;
      transform.source = *scanner;
      transform.target = frame.value_or("scene");
      std::get<std::optional<velum::Transform>>(known) = std::move(transform);
      return known;
    }
    const Object& asked = read.object(*object);
    std::get<std::optional<velum::Mesh>>(known) = mesh_of(asked, motion);
    if (const Sail* sail = asked.sail()) {
      std::get<std::optional<velum::Surface>>(known) = velum::scene::surface_of(*sail, motion);
      std::get<std::optional<velum::Table>>(known) = table_of(*sail, motion, heights);
      report(*sail, context);
    }
    return known;
  }
};

}  // namespace

VELUM_STAGE(Truth)
