// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "geometry/normals.hpp"

#include <fmt/format.h>

#include <velum/stage.hpp>

namespace {

struct Normals {
  std::optional<int> neighbours;
  std::optional<velum::Length> radius;
  std::optional<velum::Length> noise;
  velum::Angle accuracy = {0.026};

  static auto about() {
    return velum::About<Normals>("Normals and curvature from the neighbours of each point.")
        .in("cloud")
        .out("cloud")
        .adds("cloud", "normals")
        .adds("cloud", "curvature")
        .param(&Normals::neighbours, "neighbours",
               "points of a neighbourhood, the point itself among them; with neither this nor "
               "radius the neighbourhood is chosen point by point from spacing and noise",
               velum::at_least(3))
        .param(&Normals::radius, "radius",
               "radius of a neighbourhood; with neighbours: at most that many within it",
               velum::above(0.0))
        .param(&Normals::noise, "noise",
               "range noise (one standard deviation) that the automatic choice reckons with; "
               "unset: estimated from the cloud",
               velum::at_least(0.0))
        .param(&Normals::accuracy, "accuracy",
               "error of a normal (root mean square) that the automatic choice aims at",
               velum::between(1e-4, 0.5))
        .advanced()
        .deterministic()
        .reference("thesis 3.1.3, 3.1.4: equations 3.1, 3.2")
        .reference("R. B. Rusu, Semantic 3D Object Maps (2010): orientation to the viewpoint");
  }

  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    velum::geometry::NormalOptions options;
    options.accuracy = accuracy;
    if (neighbours) options.neighbours = *neighbours;
    if (radius) options.radius = *radius;
    if (noise) options.noise = *noise;
    auto field = velum::geometry::estimate_normals(cloud, options, context);
    report(cloud, field, context);
    return cloud.with(velum::column::kNormals, velum::Column(std::move(field.normals)))
        .with(velum::column::kCurvature, velum::Column(std::move(field.curvature)));
  }

 private:
  void report(const velum::Cloud& cloud, const velum::geometry::NormalField& field,
              velum::Context& context) const {
    context.measure("neighbours", field.neighbours, "");
    if (!neighbours && !radius) context.measure("noise", field.noise, "m");
    context.measure("degenerate", static_cast<double>(field.degenerate), "", velum::Better::lower);
    if (field.degenerate > 0)
      context.warn(
          fmt::format("{} of {} points have neighbours that fix no plane (fewer than "
                      "three distinct ones, or on one line); their normals point to the "
                      "sensor and their curvature is 0",
                      field.degenerate, cloud.size()));
  }
};

}  // namespace
VELUM_STAGE(Normals)
