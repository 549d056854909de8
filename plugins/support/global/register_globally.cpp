// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "global/register_globally.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "geometry/thinning.hpp"
#include "registration/register_planes.hpp"
#include "registration/room_scan.hpp"

namespace velum::registration {
namespace {

constexpr Index kWanted = 4000;  ///< cells of a cloud
constexpr Index kLeastPoints = 50;
/// Sizes of the cells that are tried, of the first one.
constexpr double kSizes[] = {1.0, 0.7, 1.4, 0.85, 1.2};
/// More of either cloud than this where the other scanner looked through: a wrong pose.
constexpr double kMostBlocked = 0.1;

/// Planes bring rooms together whose features are all alike. Nothing where they do not suffice.
std::optional<GlobalResult> by_planes(const Cloud& source, const Cloud& target,
                                      const GlobalOptions& options, Context& context) {
  PlanesOptions planes;
  planes.most_deviation = options.most_deviation;
  try {
    PlanesResult found = register_planes(source, target, planes, context);
    GlobalResult result;
    result.pose = found.pose;
    result.steps = std::move(found.steps);
    result.candidates = found.candidates;
    result.seen = {found.agrees, found.overlap, found.fitness};
    result.gap = found.gap;
    result.contradiction = found.blocked;
    result.by_planes = true;
    result.deviations = found.deviations;
    return result;
  } catch (const Error& error) {
    context.info(fmt::format("not by planes: {}", error.what()));
    return {};
  }
}

/// What both scanners saw past must be empty under the pose as well.
void ask_scanners(const Cloud& source, const Cloud& target, GlobalResult& result,
                  Context& context) {
  const RoomScan here = prepare(source, {}, context);
  const RoomScan there = prepare(target, {}, context);
  const Evidence seen = evidence(here, there, result.pose, 2.0 * result.cell);
  result.contradiction = std::max(seen.blocked, seen.walls_blocked);
  if (!result.refusal.empty() || result.contradiction <= kMostBlocked) return;
  result.refusal = fmt::format(
      "at the best motion {:.0f} % of the points lie where the other scanner looked through",
      100.0 * result.contradiction);
  result.hint = "the scans may be of different scenes, or something large was moved between them";
}

}  // namespace

GlobalResult register_globally(const Cloud& source, const Cloud& target,
                               const GlobalOptions& options, Context& context) {
  for (const auto& [cloud, name] : {std::pair(&source, "source"), std::pair(&target, "target")})
    if (cloud->size() < kLeastPoints || !(cloud->diagonal() > 0.0))
      throw Error(Fault::stage,
                  fmt::format("the {} has {} points{}; {} in different places are "
                              "needed to tell its shape",
                              name, cloud->size(),
                              cloud->size() < 2 || cloud->diagonal() > 0.0 ? "" : " in one place",
                              kLeastPoints));
  const bool scanners = !source.sensors().empty() && !target.sensors().empty();
  if (options.planes && scanners)
    if (auto found = by_planes(source, target, options, context)) return *found;
  const auto cell_of = [](const Cloud& cloud) {
    return geometry::cell_for(cloud.positions(), std::min(kWanted, cloud.size() / 2));
  };
  const double first =
      options.cell > 0.0 ? options.cell : std::max(cell_of(source), cell_of(target));
  std::optional<GlobalResult> best;
  for (const double size : kSizes) {
    if (size != kSizes[0] && options.cell > 0.0) break;
    GlobalResult result = try_globally(source, target, size * first, options, context);
    if (scanners && result.candidates > 0) ask_scanners(source, target, result, context);
    if (result.refusal.empty()) return result;
    if (!best || result.inliers > best->inliers) best = std::move(result);
  }
  throw Error(Fault::stage, best->refusal).hint(best->hint);
}

}  // namespace velum::registration
