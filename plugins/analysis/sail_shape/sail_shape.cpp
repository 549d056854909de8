// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include <algorithm>
#include <numbers>

#include "sail/shape.hpp"

namespace {

enum class Edge { automatic, as_is, compensated };

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

velum::Table sections_of(const velum::sail::Shape& shape) {
  velum::Table table({{"height", ""},
                      {"z", "m"},
                      {"chord", "m"},
                      {"camber", "%"},
                      {"draft", "%"},
                      {"twist", "deg"},
                      {"entry", "deg"},
                      {"exit", "deg"}});
  const auto& sections = shape.sections;
  const auto lowest =
      std::min_element(sections.begin(), sections.end(),
                       [](const auto& a, const auto& b) { return a.height < b.height; });
  for (const velum::sail::Section& one : sections)
    table.add({one.height, one.z, one.chord, 100.0 * one.camber, 100.0 * one.draft,
               degrees(one.angle - lowest->angle), degrees(one.entry), degrees(one.exit)});
  return table;
}

velum::Table corners_of(const velum::sail::Shape& shape) {
  velum::Table table({{"corner", ""}, {"x", "m"}, {"y", "m"}, {"z", "m"}});
  const auto add = [&](const char* name, const Eigen::Vector3d& at) {
    table.add({std::string(name), at.x(), at.y(), at.z()});
  };
  add("tack", shape.tack);
  add("clew", shape.clew);
  add("head", shape.head);
  add("peak", shape.peak);
  return table;
}

struct SailShape {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  std::optional<Eigen::Vector3d> bow;
  std::vector<double> heights{0.25, 0.5, 0.75};
  Edge border = Edge::automatic;
  double band = 0.1;
  double tangent = 0.1;

  static auto about() {
    return velum::About<SailShape>(
               "Corners, border lengths, area and sections of a sail: chord, camber, draft, twist, "
               "entry and exit angles.")
        .in("mesh", "of one sail")
        .out("table", "one row a section, in the order of `heights`")
        .out("corners", "tack, clew, head and peak (the leech's upper end)")
        .param(&SailShape::up, "up", "direction to the masthead; sections are normal to it")
        .param(&SailShape::bow, "bow",
               "direction to the bow, from leech to luff; unset: [1, 0, 0], with a warning")
        .param(&SailShape::heights, "heights",
               "of the sections, as shares of the way from tack to head", velum::between(0.0, 1.0))
        .choice(&SailShape::border, "border", "where the sail's edge is",
                {{"auto", Edge::automatic,
                  "compensated where the vertices know beam, line and scanner, else as_is"},
                 {"as_is", Edge::as_is, "along the border of the mesh"},
                 {"compensated", Edge::compensated,
                  "half a scan step outside the last returns, as a scan ends before the cloth"}})
        .param(
            &SailShape::band, "band",
            "half width of the band of points that a section of a mesh is fitted to, as a share of "
            "the height",
            velum::between(0.005, 0.5))
        .advanced()
        .param(&SailShape::tangent, "tangent",
               "share of the chord over which the entry and exit angles of a mesh are fitted",
               velum::between(0.01, 0.5))
        .advanced()
        .deterministic()
        .reference("Canciani, thesis, 3.4.2 (border lengths as the test of an acquisition)")
        .reference(
            "Eilers and Marx, Flexible smoothing with B-splines and penalties, Statistical "
            "Science 11 (1996)");
  }

  void check() const {
    if (heights.empty())
      throw velum::Error(velum::Fault::graph, "'heights' is empty").at("heights");
  }

  std::tuple<velum::Table, velum::Table> operator()(
      const std::variant<velum::Mesh, velum::Surface>& input, velum::Context& context) const {
    const velum::sail::Shape shape = measured(input, context);
    context.measure("luff", shape.luff, "m");
    context.measure("leech", shape.leech, "m");
    context.measure("foot", shape.foot, "m");
    context.measure("area", shape.area, "m^2");
    context.measure("compensated", compensate(input) ? 1.0 : 0.0, "");
    context.measure("border_moved", shape.moved, "m");
    return {sections_of(shape), corners_of(shape)};
  }

 private:
  using Input = std::variant<velum::Mesh, velum::Surface>;

  [[nodiscard]] velum::sail::Shape measured(const Input& input, velum::Context& context) const {
    const bool outward = compensate(input);
    if (!bow)
      context.warn(
          "'bow' is not given: [1, 0, 0] is taken to point to the bow; luff and leech change "
          "places "
          "where it points aft");
    const Eigen::Vector3d forward = bow.value_or(Eigen::Vector3d::UnitX());
    context.info(outward ? "the border was moved outward by half a scan step (border = compensated)"
                         : "the border is that of the input (border = as_is)");
    if (const auto* surface = std::get_if<velum::Surface>(&input))
      return velum::sail::measure(*surface, up, forward, heights, context);
    return velum::sail::measure(std::get<velum::Mesh>(input), up, forward,
                                {heights, band, tangent, outward}, context);
  }

  [[nodiscard]] bool compensate(const Input& input) const {
    const auto* mesh = std::get_if<velum::Mesh>(&input);
    const bool possible = mesh != nullptr && velum::sail::is_scan(*mesh);
    if (border == Edge::compensated && !possible)
      throw velum::Error(
          velum::Fault::stage,
          "border = \"compensated\" needs a mesh with the columns beam and line and a "
          "scanner, and the input lacks one of them")
          .hint("keep the scan's columns up to the mesh, or use border = \"as_is\"");
    return border == Edge::compensated || (border == Edge::automatic && possible);
  }
};

}  // namespace

VELUM_STAGE(SailShape)
