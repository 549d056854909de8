// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "geometry/find_planes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/thinning.hpp"
#include "velum/random.hpp"

namespace velum::geometry {
namespace {

constexpr Index kNeighbours = 13;
constexpr Index kWantedCells = 16000;
/// Cells farther than this share of their edge from a plane are not of it while it grows.
constexpr double kTolerance = 0.25;
/// λ0/Σλ up to which a cell may start a plane.
constexpr float kFlat = 0.02F;
/// Fewer cells than this make no plane: the caps of a bent sheet that are flat to the tolerance.
constexpr std::size_t kLeastCells = 40;
constexpr int kTrials = 64;
/// How far around its cells a plane is looked for, as a share of their extent.
constexpr double kAround = 0.5;
/// Points within this many RMS distances belong to a plane.
constexpr double kBand = 4.0;

struct Cells {
  Cloud cloud;
  double edge = 0.0;
  std::vector<std::int32_t> near;  ///< kNeighbours a cell, -1 where there are fewer
  std::vector<Eigen::Vector3f> normals;
  std::vector<float> curvature;

  [[nodiscard]] Eigen::Vector3d mean(std::int32_t c) const {
    return cloud.positions().col(c).cast<double>();
  }
};

Cells make_cells(Points means, double edge, Context& context) {
  Cells cells{Cloud(std::move(means)), edge, {}, {}, {}};
  const auto n = static_cast<std::size_t>(cells.cloud.size());
  cells.near.assign(n * kNeighbours, -1);
  cells.normals.assign(n, Eigen::Vector3f::Zero());
  cells.curvature.assign(n, 1.0F);
  const auto reach = static_cast<float>(9.0 * edge * edge);
  const auto visit = [&](Index query, std::span<const Neighbour> found) {
    const auto c = static_cast<std::size_t>(query);
    PointMoments moments(cells.mean(static_cast<std::int32_t>(query)));
    std::size_t used = 0;
    for (const Neighbour& neighbour : found) {
      if (neighbour.distance2 > reach) break;
      cells.near[c * kNeighbours + used++] = neighbour.index;
      moments.add(cells.mean(neighbour.index));
    }
    if (used < 5) return;
    const PlaneFit fit = moments.plane();
    cells.normals[c] = fit.normal.cast<float>();
    cells.curvature[c] = static_cast<float>(fit.curvature());
  };
  cells.cloud.neighbours().each_nearest(kNeighbours, context, visit);
  return cells;
}

/// Planes as lists of cells.
class Growing {
 public:
  Growing(const Cells& cells, const PlaneSearch& search)
      : cells_(cells), cosine_(std::cos(search.angle)), tolerance_(kTolerance * cells.edge) {
    region_.assign(cells.normals.size(), -1);
  }

  std::vector<std::vector<std::int32_t>> run(std::size_t least, Context& context) {
    std::vector<std::int32_t> seeds(region_.size());
    std::iota(seeds.begin(), seeds.end(), 0);
    std::stable_sort(seeds.begin(), seeds.end(), [&](std::int32_t a, std::int32_t b) {
      return cells_.curvature[static_cast<std::size_t>(a)] <
             cells_.curvature[static_cast<std::size_t>(b)];
    });
    std::vector<std::vector<std::int32_t>> regions;
    for (const std::int32_t seed : seeds) {
      if (cells_.curvature[static_cast<std::size_t>(seed)] > kFlat) break;
      if (region_[static_cast<std::size_t>(seed)] >= 0) continue;
      context.check();
      auto region = grow(seed);
      if (region.size() >= least) {
        ++number_;
        regions.push_back(std::move(region));
      } else {
        // Given back, for a larger plane may still want them.
        for (const std::int32_t c : region) region_[static_cast<std::size_t>(c)] = -1;
      }
    }
    return regions;
  }

 private:
  std::vector<std::int32_t> grow(std::int32_t seed) {
    PointMoments moments(cells_.mean(seed));
    for_each_near(seed, [&](std::int32_t c) { moments.add(cells_.mean(c)); });
    PlaneFit plane = moments.plane();
    moments = PointMoments(cells_.mean(seed));
    std::vector<std::int32_t> region{seed};
    region_[static_cast<std::size_t>(seed)] = number_;
    std::size_t refit = 8;
    for (std::size_t next = 0; next < region.size(); ++next) {
      moments.add(cells_.mean(region[next]));
      if (next == refit) {
        plane = moments.plane();
        refit += refit / 2;
      }
      for_each_near(region[next], [&](std::int32_t c) {
        if (region_[static_cast<std::size_t>(c)] >= 0 || !fits(plane, c)) return;
        region_[static_cast<std::size_t>(c)] = number_;
        region.push_back(c);
      });
    }
    return region;
  }

  template <class Visit>
  void for_each_near(std::int32_t cell, const Visit& visit) const {
    const std::size_t first = static_cast<std::size_t>(cell) * kNeighbours;
    for (std::size_t k = first; k < first + kNeighbours && cells_.near[k] >= 0; ++k)
      visit(cells_.near[k]);
  }

  [[nodiscard]] bool fits(const PlaneFit& plane, std::int32_t cell) const {
    const auto at = static_cast<std::size_t>(cell);
    return std::abs(plane.distance(cells_.mean(cell))) < tolerance_ &&
           std::abs(plane.normal.dot(cells_.normals[at].cast<double>())) > cosine_;
  }

  const Cells& cells_;
  double cosine_;
  double tolerance_;
  std::vector<std::int32_t> region_;
  std::int32_t number_ = 0;
};

PlaneFit through(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  PlaneFit plane;
  plane.centroid = a;
  plane.normal = (b - a).cross(c - a).normalized();
  return plane;
}

PointMoments within(const Cells& cells, const std::vector<std::int32_t>& region,
                    const PlaneFit& plane, double band) {
  PointMoments moments(plane.centroid);
  for (const std::int32_t c : region)
    if (std::abs(plane.distance(cells.mean(c))) < band) moments.add(cells.mean(c));
  return moments;
}

/// The plane that most cells of a region agree on (RANSAC, thesis 3.3.2), then least squares over
/// these.
PlaneFit settle(const Cells& cells, const std::vector<std::int32_t>& region) {
  Random random(region.size());
  const auto any = [&] {
    return cells.mean(
        region[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(region.size())))]);
  };
  const double band = 0.5 * kTolerance * cells.edge;
  PlaneFit best = within(cells, region, {}, 1e300).plane();
  double most = within(cells, region, best, band).weight();
  for (int trial = 0; trial < kTrials; ++trial) {
    const PlaneFit plane = through(any(), any(), any());
    if (!plane.normal.allFinite()) continue;
    const double agree = within(cells, region, plane, band).weight();
    if (agree > most) {
      most = agree;
      best = plane;
    }
  }
  const PointMoments kept = within(cells, region, best, band);
  return kept.weight() >= 3.0 ? kept.plane() : best;
}

struct Flat {
  PlaneFit fit;
  std::vector<std::int32_t> cells;
};

bool same_plane(const Flat& large, const Flat& small, double tolerance) {
  return std::abs(large.fit.normal.dot(small.fit.normal)) > std::cos(0.07) &&
         std::abs(large.fit.distance(small.fit.centroid)) < tolerance;
}

/// Parts of one plane (a wall behind a mast) become one; largest first.
std::vector<Flat> join(const Cells& cells, std::vector<std::vector<std::int32_t>> regions) {
  std::stable_sort(regions.begin(), regions.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  std::vector<Flat> joined;
  for (auto& region : regions) {
    Flat part{settle(cells, region), std::move(region)};
    const auto whole = std::find_if(joined.begin(), joined.end(), [&](const Flat& one) {
      return same_plane(one, part, kTolerance * cells.edge);
    });
    if (whole == joined.end()) {
      joined.push_back(std::move(part));
    } else {
      whole->cells.insert(whole->cells.end(), part.cells.begin(), part.cells.end());
      whole->fit = settle(cells, whole->cells);
    }
  }
  std::stable_sort(joined.begin(), joined.end(),
                   [](const Flat& a, const Flat& b) { return a.cells.size() > b.cells.size(); });
  return joined;
}

/// Where a plane may have points: the rectangle of its cells, and some way around, since the cells
/// where walls meet and the sparse lines at grazing angles have no normal to be grown by.
struct Extent {
  Eigen::Matrix<double, 2, 3> axes;
  Eigen::AlignedBox2d box;

  Extent(const Cells& cells, const Flat& flat) {
    const Eigen::Vector3d first = flat.fit.normal.unitOrthogonal();
    axes << first.transpose(), flat.fit.normal.cross(first).transpose();
    for (const std::int32_t c : flat.cells) box.extend(axes * cells.mean(c));
    const Eigen::Vector2d around = kAround * box.sizes();
    box = Eigen::AlignedBox2d(box.min() - around, box.max() + around);
  }
};

/// Gives points to planes: each point to the nearest plane whose band and extent it lies in.
class Assignment {
 public:
  Assignment(const Cloud& cloud, const Cells& cells, const std::vector<Flat>& flats,
             Context& context)
      : cloud_(cloud), edge_(cells.edge), context_(context) {
    for (const Flat& flat : flats) {
      ScenePlane& plane = planes_.emplace_back();
      plane.fit = flat.fit;
      plane.area = static_cast<double>(flat.cells.size()) * edge_ * edge_;
      bands_.push_back(kTolerance * edge_);
      extents_.emplace_back(cells, flat);
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
  const Cells cells = make_cells(std::move(thinned.means), thinned.cell, context);
  const auto least = std::max<std::size_t>(
      kLeastCells,
      static_cast<std::size_t>(search.min_share * static_cast<double>(cells.cloud.size())));
  std::vector<Flat> flats = join(cells, Growing(cells, search).run(least, context));
  if (flats.size() > static_cast<std::size_t>(search.max_planes))
    flats.resize(static_cast<std::size_t>(search.max_planes));
  ScenePlanes scene = Assignment(cloud, cells, flats, context).run();
  face_sensors(cloud, scene);
  return scene;
}

}  // namespace velum::geometry
