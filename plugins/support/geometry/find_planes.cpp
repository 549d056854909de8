// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "geometry/find_planes.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/plane_cells.hpp"
#include "geometry/thinning.hpp"

namespace velum::geometry {
namespace {

constexpr Index kWantedCells = 16000;
/// Fewer cells than this make no plane: the caps of a bent sheet that are flat to the tolerance.
constexpr std::size_t kLeastCells = 40;
/// How far around its cells a plane is looked for, as a share of their extent.
constexpr double kAround = 0.5;
/// Points within this many RMS distances belong to a plane.
constexpr double kBand = 4.0;

/// Where a plane may have points: the rectangle of its cells, and some way around, since the cells
/// where walls meet and the sparse lines at grazing angles have no normal to be grown by.
struct Extent {
  Eigen::Matrix<double, 2, 3> axes;
  Eigen::AlignedBox2d box;

  Extent(const PlaneCells& cells, const GrownPlane& plane) {
    const Eigen::Vector3d first = plane.fit.normal.unitOrthogonal();
    axes << first.transpose(), plane.fit.normal.cross(first).transpose();
    for (const std::int32_t c : plane.cells) box.extend(axes * cells.mean(c));
    const Eigen::Vector2d around = kAround * box.sizes();
    box = Eigen::AlignedBox2d(box.min() - around, box.max() + around);
  }
};

/// Gives points to planes: each point to the nearest plane whose band and extent it lies in.
class Assignment {
 public:
  Assignment(const Cloud& cloud, const PlaneCells& cells, const std::vector<GrownPlane>& grown,
             Context& context)
      : cloud_(cloud), edge_(cells.edge), context_(context) {
    for (const GrownPlane& one : grown) {
      ScenePlane& plane = planes_.emplace_back();
      plane.fit = one.fit;
      plane.area = static_cast<double>(one.cells.size()) * edge_ * edge_;
      bands_.push_back(kPlaneTolerance * edge_);
      extents_.emplace_back(cells, one);
    }
  }

  ScenePlanes run() {
    for (int round = 0; round < 3; ++round) {
      assign();
      refit();
    }
    assign();
    return {std::move(planes_), std::move(plane_of_), edge_};
  }

 private:
  void assign() {
    const auto positions = cloud_.positions();
    plane_of_.assign(static_cast<std::size_t>(cloud_.size()), -1);
    parallel_for(context_, cloud_.size(), 8192, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const Eigen::Vector3d point = positions.col(i).cast<double>();
        double nearest = 1.0;
        for (std::size_t p = 0; p < planes_.size(); ++p) {
          const double distance = std::abs(planes_[p].fit.distance(point)) / bands_[p];
          if (distance >= nearest || !extents_[p].box.contains(extents_[p].axes * point)) continue;
          nearest = distance;
          plane_of_[at] = static_cast<std::int32_t>(p);
        }
      }
    });
  }

  void refit() {
    std::vector<PointMoments> moments;
    for (const ScenePlane& plane : planes_) moments.emplace_back(plane.fit.centroid);
    for (std::size_t i = 0; i < plane_of_.size(); ++i)
      if (plane_of_[i] >= 0)
        moments[static_cast<std::size_t>(plane_of_[i])].add(
            cloud_.positions().col(static_cast<Index>(i)).cast<double>());
    for (std::size_t p = 0; p < planes_.size(); ++p) {
      planes_[p].points = static_cast<Index>(moments[p].weight());
      if (planes_[p].points < 3) continue;
      planes_[p].fit = moments[p].plane();
      planes_[p].covariance = moments[p].covariance();
      bands_[p] = std::min(bands_[p], std::max(kBand * planes_[p].fit.rms(), 1e-6 * edge_));
    }
  }

  const Cloud& cloud_;
  double edge_;
  Context& context_;
  std::vector<ScenePlane> planes_;
  std::vector<double> bands_;
  std::vector<Extent> extents_;
  std::vector<std::int32_t> plane_of_;
};

void face_sensors(const Cloud& cloud, ScenePlanes& scene) {
  std::vector<char> done(scene.planes.size(), 0);
  for (Index i = 0; i < cloud.size(); ++i) {
    const std::int32_t p = scene.plane_of[static_cast<std::size_t>(i)];
    if (p < 0 || done[static_cast<std::size_t>(p)] != 0) continue;
    done[static_cast<std::size_t>(p)] = 1;
    const auto sensor = cloud.sensor_of(i);
    const Eigen::Vector3d eye =
        sensor ? cloud.sensor_position(*sensor).cast<double>() : Eigen::Vector3d(-cloud.origin());
    PlaneFit& fit = scene.planes[static_cast<std::size_t>(p)].fit;
    if (fit.distance(eye) < 0.0) fit.normal = -fit.normal;
  }
}

}  // namespace

ScenePlanes find_planes(const Cloud& cloud, const PlaneSearch& search, Context& context) {
  const Index wanted = std::min<Index>(kWantedCells, cloud.size() / 3);
  const double edge = search.cell > 0.0 ? search.cell : cell_for(cloud.positions(), wanted);
  if (cloud.size() < 3 || !(edge > 0.0))
    return {{}, std::vector<std::int32_t>(static_cast<std::size_t>(cloud.size()), -1), edge};
  Thinned thinned = thin(cloud.positions(), edge);
  const PlaneCells cells = make_plane_cells(std::move(thinned.means), thinned.cell, context);
  const auto least = std::max<std::size_t>(
      kLeastCells,
      static_cast<std::size_t>(search.min_share * static_cast<double>(cells.cloud.size())));
  std::vector<GrownPlane> grown =
      join_planes(cells, grow_planes(cells, search.angle, least, context));
  if (grown.size() > static_cast<std::size_t>(search.max_planes))
    grown.resize(static_cast<std::size_t>(search.max_planes));
  ScenePlanes scene = Assignment(cloud, cells, grown, context).run();
  face_sensors(cloud, scene);
  return scene;
}

}  // namespace velum::geometry
