// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/room_scan.hpp"

#include <algorithm>

#include "geometry/thinning.hpp"

namespace velum::registration {
namespace {

constexpr Index kRestThin = 4000;
constexpr Index kWallThin = 3000;

Points at(const Cloud& cloud, const std::vector<std::int32_t>& indices) {
  Points points(3, static_cast<Index>(indices.size()));
  for (std::size_t k = 0; k < indices.size(); ++k)
    points.col(static_cast<Index>(k)) = cloud.positions().col(indices[k]);
  return points;
}

ConstPoints view(const Points& points) {
  return {points.data(), 3, points.cols()};
}

Points thinned(const Points& points, Index wanted, double& cell) {
  cell = geometry::cell_for(view(points), std::min(wanted, std::max<Index>(1, points.cols())));
  return cell > 0.0 ? geometry::thin(view(points), cell).means : points;
}

RoomScan::Eye eye_of(const Cloud& cloud, const geometry::ScenePlanes& scene,
                     const Eigen::Vector3d& position, std::optional<std::size_t> sensor) {
  std::vector<std::int32_t> mine;
  std::vector<char> is_rest;
  for (Index i = 0; i < cloud.size(); ++i)
    if (!sensor || cloud.sensor_of(i) == sensor) {
      mine.push_back(static_cast<std::int32_t>(i));
      is_rest.push_back(scene.plane_of[static_cast<std::size_t>(i)] < 0 ? 1 : 0);
    }
  Points points = at(cloud, mine);
  points.colwise() -= position.cast<float>();
  return {position, RangeImage(points, is_rest)};
}

struct Count {
  Index agrees = 0;
  Index blocked = 0;
  Index asked = 0;
};

void ask(const Points& points, const Pose& pose, const RoomScan& other, double margin, Index stride,
         Count& count) {
  const Eigen::Matrix3f turn = pose.linear().cast<float>();
  for (Index i = 0; i < points.cols(); i += stride) {
    ++count.asked;
    bool agrees = false;
    bool blocked = false;
    for (const RoomScan::Eye& eye : other.eyes) {
      const Eigen::Vector3f shift = (pose.translation() - eye.position).cast<float>();
      const auto sight = eye.image.look(turn * points.col(i) + shift, static_cast<float>(margin));
      agrees = agrees || sight == RangeImage::Sight::agrees;
      blocked = blocked || sight == RangeImage::Sight::blocked;
    }
    count.blocked += blocked ? 1 : 0;
    count.agrees += agrees && !blocked ? 1 : 0;
  }
}

double share(Index part, Index whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

}  // namespace

RoomScan prepare(const Cloud& cloud, const geometry::PlaneSearch& search, Context& context) {
  RoomScan scan;
  scan.cloud = cloud;
  scan.scene = geometry::find_planes(cloud, search, context);
  std::vector<std::int32_t> walls;
  for (std::size_t i = 0; i < scan.scene.plane_of.size(); ++i)
    (scan.scene.plane_of[i] < 0 ? scan.rest : walls).push_back(static_cast<std::int32_t>(i));
  double unused = 0.0;
  scan.rest_thin = thinned(at(cloud, scan.rest), kRestThin, scan.fine);
  scan.wall_thin = thinned(at(cloud, walls), kWallThin, unused);
  context.check();
  for (std::size_t s = 0; s < cloud.sensors().size(); ++s)
    scan.eyes.push_back(eye_of(cloud, scan.scene, cloud.sensor_position(s).cast<double>(), s));
  if (scan.eyes.empty()) scan.eyes.push_back(eye_of(cloud, scan.scene, -cloud.origin(), {}));
  return scan;
}

Evidence evidence(const RoomScan& source, const RoomScan& target, const Pose& pose, double margin,
                  Index stride) {
  Count rest;
  Count walls;
  const Pose back = pose.inverse();
  ask(source.rest_thin, pose, target, margin, stride, rest);
  ask(target.rest_thin, back, source, margin, stride, rest);
  ask(source.wall_thin, pose, target, margin, stride, walls);
  ask(target.wall_thin, back, source, margin, stride, walls);
  return {share(rest.agrees, rest.asked), share(rest.blocked, rest.asked),
          share(walls.blocked, walls.asked)};
}

}  // namespace velum::registration
