// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "graph/diagnostic.hpp"
#include "scene/parts.hpp"
#include "scene/scene.hpp"
#include "velum/files.hpp"
#include "velum/parameter.hpp"

namespace velum::scene {
namespace {

using Eigen::Vector3d;

// A pose whose z is `normal` and whose x is as near to `along` as that allows.
Pose facing(const Vector3d& position, const Vector3d& normal, const Vector3d& along) {
  Pose pose = Pose::Identity();
  Vector3d x = along - along.dot(normal) * normal;
  x = x.norm() > 1e-6 ? x.normalized() : normal.unitOrthogonal();
  pose.linear() << x, normal.cross(x), normal;
  pose.translation() = position;
  return pose;
}

Plane plane_of(Keys& keys, const Pose& frame) {
  Plane plane;
  plane.pose = frame * facing(keys.place("position"), keys.direction("normal", Vector3d::UnitZ()),
                              keys.direction("along", Vector3d::UnitX()));
  if (!keys.has("size")) return plane;
  const auto size = keys.lengths("size", 2);
  if (size[0] <= 0.0 || size[1] <= 0.0) keys.fail("size", "must be above 0");
  plane.half_x = 0.5 * size[0];
  plane.half_y = 0.5 * size[1];
  return plane;
}

Vector3d positive(Keys& keys, std::string_view key) {
  const Vector3d sizes = keys.place(key);
  if (sizes.minCoeff() <= 0.0) keys.fail(key, "must be above 0");
  return sizes;
}

Cylinder cylinder_of(const Vector3d& from, const Vector3d& to, double radius, const Pose& frame) {
  return {frame * from, frame * to, radius};
}

std::vector<Shape> cylinders(Keys& keys, const Pose& frame, const SceneFile& file) {
  const double radius = keys.length("radius");
  std::vector<Shape> shapes;
  for (const Node& one : keys.array("lines")) {
    if (!one.is(graph::toml::Kind::array) || one.items.size() < 2)
      file.fail(one.where, "a line must be an array of at least two points");
    for (std::size_t i = 0; i + 1 < one.items.size(); ++i) {
      const Vector3d from = keys.place_of(one.items[i], "a point of a line");
      const Vector3d to = keys.place_of(one.items[i + 1], "a point of a line");
      if ((to - from).norm() < 1e-9) file.fail(one.where, "two points of this line are the same");
      shapes.emplace_back(cylinder_of(from, to, radius, frame));
    }
  }
  return shapes;
}

Cone cone_of(Keys& keys, const Pose& frame) {
  const Cone cone{frame * keys.place("apex"), frame * keys.place("base"), keys.length("radius")};
  if ((cone.base - cone.apex).norm() < 1e-9) keys.fail("base", "is the same point as apex");
  if (cone.radius <= 0.0) keys.fail("radius", "must be above 0");
  return cone;
}

TriangleSet mesh_of(Keys& keys, const Pose& frame, const SceneFile& file) {
  const Pose pose = frame * keys.pose();
  TriangleSet set;
  const auto& vertices = keys.array("vertices");
  set.vertices.resize(3, static_cast<Index>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i)
    set.vertices.col(static_cast<Index>(i)) = pose * keys.place_of(vertices[i], "a vertex");
  const auto& triangles = keys.array("triangles");
  set.triangles.resize(3, static_cast<Index>(triangles.size()));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Node& one = triangles[i];
    if (!one.is(graph::toml::Kind::array) || one.items.size() != 3)
      file.fail(one.where, "a triangle must be an array of three vertex numbers");
    for (std::size_t k = 0; k < 3; ++k) {
      const Node& corner = one.items[k];
      if (!corner.is(graph::toml::Kind::integer) || corner.integer < 0 ||
          corner.integer >= static_cast<std::int64_t>(vertices.size()))
        file.fail(corner.where, "a triangle's corner must be a vertex number from 0 to " +
                                    std::to_string(vertices.size() - 1));
      set.triangles(static_cast<Index>(k), static_cast<Index>(i)) =
          static_cast<std::int32_t>(corner.integer);
    }
  }
  return set;
}

SailSection section_of(const SceneFile& file, const Node& node) {
  Keys keys(file, node, "a section");
  SailSection section;
  section.height = keys.number_between("height", 0, 1);
  section.chord = keys.length("chord");
  section.camber = keys.number_between("camber", 0, 45) / 100.0;
  section.draft = keys.number_between("draft", 34, 66) / 100.0;
  section.twist = keys.angle("twist", 0.0);
  keys.finish();
  return section;
}

Sail sail_of(Keys& keys, const Pose& frame, const SceneFile& file) {
  SailDesign design;
  design.tack = frame * keys.place("tack");
  design.head = frame * keys.place("head");
  design.up = frame.linear().col(2);
  const Vector3d bow = keys.direction("bow", Vector3d::UnitX());
  if (std::abs(bow.z()) > 1e-6) keys.fail("bow", "must be horizontal");
  design.aft = -(frame.linear() * bow);
  const std::string lee = keys.text("leeward");
  if (lee != "port" && lee != "starboard")
    keys.fail("leeward", "must be \"port\" or \"starboard\"; it is \"" + lee + "\"");
  design.lee = (lee == "port" ? -1.0 : 1.0) * design.up.cross(design.aft);
  design.sag_aft = keys.length("sag_aft", 0.0);
  design.sag_lee = keys.length("sag_lee", 0.0);
  design.angle = keys.angle("angle", 0.0);
  design.clew_height = keys.number("clew_height", 0.0);
  design.foot_round = keys.length("foot_round", 0.0);
  if ((design.head - design.tack).dot(design.up) <= 0.0) keys.fail("head", "must lie above tack");
  if (std::abs(design.clew_height) > 0.5) keys.fail("clew_height", "must be between -0.5 and 0.5");
  for (const Node& one : keys.array("sections")) {
    design.sections.push_back(section_of(file, one));
    const std::size_t n = design.sections.size();
    if (n > 1 && design.sections[n - 1].height <= design.sections[n - 2].height)
      file.fail(one.where, "sections must be in ascending order of height");
  }
  return Sail(std::move(design));
}

Object object_of(const SceneFile& file, const Entry& entry, const Frames& frames,
                 const Materials& materials) {
  Keys keys(file, entry.value, "object '" + entry.key + "'");
  Object object;
  object.name = entry.key;
  object.label = keys.integer("label");
  if (keys.has("material")) object.material = material_of(keys, materials);
  const Pose frame = frame_of(keys, frames);
  const std::string shape = keys.text("shape");
  if (shape == "plane")
    object.shapes.emplace_back(plane_of(keys, frame));
  else if (shape == "box")
    object.shapes.emplace_back(Box{frame * keys.pose(), 0.5 * positive(keys, "size")});
  else if (shape == "ellipsoid")
    object.shapes.emplace_back(Ellipsoid{frame * keys.pose(), positive(keys, "semi_axes")});
  else if (shape == "cylinder")
    object.shapes = cylinders(keys, frame, file);
  else if (shape == "cone")
    object.shapes.emplace_back(cone_of(keys, frame));
  else if (shape == "mesh")
    object.shapes.emplace_back(mesh_of(keys, frame, file));
  else if (shape == "sail")
    object.shapes.emplace_back(sail_of(keys, frame, file));
  else
    keys.fail("shape", "is \"" + shape + "\", which is no shape",
              graph::known_list({"plane", "box", "ellipsoid", "cylinder", "cone", "mesh", "sail"}));
  keys.finish();
  return object;
}

Node parse_document(std::string_view text, const SceneFile& file) {
  try {
    return graph::toml::parse(text);
  } catch (const graph::toml::SyntaxError& error) {
    file.fail(error.where(), error.what(), error.hint());
  }
}

template <class Visit>
void each(Keys& top, std::string_view key, const SceneFile& file, const Visit& visit) {
  if (!top.has(key)) return;
  const Node& table = top.node(key);
  if (!table.is(graph::toml::Kind::table))
    file.fail(table.where, "'" + std::string(key) + "' must hold named tables, such as [" +
                               std::string(key) + ".name]");
  for (const Entry& entry : table.entries) visit(entry);
}

}  // namespace

Scene parse_scene(std::string_view text, const std::filesystem::path& path) {
  SceneFile file{path.string()};
  const Node document = parse_document(text, file);
  Keys top(file, document, "the scene");
  if (top.integer("format") != 1) top.fail("format", "must be 1");
  Scene scene;
  scene.path = file.name;
  if (top.has("title")) scene.title = top.text("title");
  try {
    file.metre = length_unit(top.text("units")).metres;
  } catch (const Error& error) {
    top.fail("units", std::string("is no unit of length: ") + error.what(), error.hint());
  }
  Frames frames;
  each(top, "frame", file, [&](const Entry& entry) {
    Keys keys(file, entry.value, "frame '" + entry.key + "'");
    const Pose parent = frame_of(keys, frames);
    frames[entry.key] = parent * keys.pose();
    keys.finish();
  });
  Materials materials;
  each(top, "material", file,
       [&](const Entry& entry) { materials[entry.key] = read_material(file, entry, materials); });
  if (top.has("sun")) scene.sun = read_sun(file, top.node("sun"));
  each(top, "object", file, [&](const Entry& entry) {
    scene.objects.push_back(object_of(file, entry, frames, materials));
  });
  each(top, "scanner", file,
       [&](const Entry& entry) { scene.scanners.push_back(read_scanner(file, entry, frames)); });
  top.finish();
  return scene;
}

Scene read_scene(const std::filesystem::path& path) {
  const FileContent content(path, std::uint64_t{1} << 20U);
  return parse_scene(content.text(), path);
}

}  // namespace velum::scene
