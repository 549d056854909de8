// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/icp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/eigen3.hpp"
#include "geometry/rigid_fit.hpp"
#include "registration/pairs.hpp"

namespace velum::registration {
namespace {

constexpr Index kGrain = 4096;
/// Weaker directions carry nothing but rounding; moving along them would only wander.
constexpr double kCutoff = 1e-5;
/// Errors below this share of the scene's square are zero to single precision.
constexpr double kExact = 1e-15;

/// What one pass over the pairs gives: sums for either metric, about fixed centres.
struct Sums {
  explicit Sums(const Eigen::Vector3d& centre) : planes(centre) {}
  Index pairs = 0;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  double squares = 0.0;
  NormalEquations planes;

  void add(const Sums& other) {
    pairs += other.pairs;
    from += other.from;
    to += other.to;
    correlation += other.correlation;
    spread += other.spread;
    squares += other.squares;
    planes.add(other.planes);
  }
};

class Icp {
 public:
  Icp(const Cloud& source, const Cloud& target, const IcpOptions& options, Context& context)
      : source_(source), target_(target), options_(options), context_(context) {
    barycentre_ = Eigen::Vector3d::Zero();
    for (Index i = 0; i < source.size(); ++i)
      barycentre_ += source.positions().col(i).cast<double>();
    barycentre_ /= static_cast<double>(source.size());
    if (options.metric == Metric::point_to_plane) normals_.emplace(target.normals());
  }

  IcpResult run(const Pose& start) {
    result_.pose = start;
    for (int level = options_.levels - 1; level >= 0; --level) run_level(level);
    return std::move(result_);
  }

 private:
  void run_level(int level) {
    ClosestPairs pairs(every(Index{1} << (2 * level)), target_);
    double before = std::numeric_limits<double>::quiet_NaN();
    result_.converged = false;
    for (int k = 0;; ++k) {
      context_.check();
      pairs.update(result_.pose, options_.max_distance, context_);
      const Sums sums = accumulate(pairs);
      const double error = error_of(sums);
      IcpStep step;
      step.pairs = sums.pairs;
      step.error = error;
      step.relative_change = std::abs(before - error) / std::max(before, 1e-300);
      result_.converged = step.relative_change < options_.relative_change ||
                          error < kExact * radius_of(sums) * radius_of(sums);
      const bool last = result_.converged || k == options_.iterations;
      if (!last) move(sums, step);
      step.barycentre = result_.pose * barycentre_ + target_.origin();
      result_.steps.push_back(step);
      before = error;
      if (last) return finish(sums, pairs);
      context_.progress(static_cast<double>(k + 1) / options_.iterations);
    }
  }

  [[nodiscard]] Points every(Index stride) const {
    const auto positions = source_.positions();
    Points chosen(3, (positions.cols() + stride - 1) / stride);
    for (Index i = 0; i < chosen.cols(); ++i) chosen.col(i) = positions.col(i * stride);
    return chosen;
  }

  /// Distance within which pairs count: the keep-th quantile of those found.
  [[nodiscard]] double limit(const ClosestPairs& pairs) const {
    if (options_.keep >= 1.0) return std::numeric_limits<double>::infinity();
    std::vector<double> distances;
    for (Index i = 0; i < pairs.size(); ++i)
      if (pairs.match(i) >= 0) distances.push_back(pairs.distance(i));
    if (distances.empty()) return 0.0;
    const auto rank =
        static_cast<std::ptrdiff_t>(options_.keep * static_cast<double>(distances.size() - 1));
    std::nth_element(distances.begin(), distances.begin() + rank, distances.end());
    return distances[static_cast<std::size_t>(rank)];
  }

  [[nodiscard]] Sums accumulate(const ClosestPairs& pairs) const {
    const Eigen::Vector3d centre = result_.pose * barycentre_;
    const double most = limit(pairs);
    const auto part = [&](Index begin, Index end) {
      Sums sums(centre);
      for (Index i = begin; i < end; ++i) {
        const std::int32_t match = pairs.match(i);
        if (match >= 0 && pairs.distance(i) <= most) add_pair(sums, pairs.moved(i), match);
      }
      return sums;
    };
    Sums sums = parallel_reduce(context_, pairs.size(), kGrain, Sums(centre), part,
                                [](Sums& total, const Sums& one) { total.add(one); });
    require_pairs(sums.pairs, pairs);
    return sums;
  }

  void add_pair(Sums& sums, const Eigen::Vector3d& point, std::int32_t match) const {
    const Eigen::Vector3d target = target_.positions().col(match).cast<double>();
    // Normals of points without neighbours may be unset or not finite: such pairs say nothing.
    if (normals_ && !(std::abs(normals_->col(match).squaredNorm() - 1.0F) < 0.1F)) return;
    const Eigen::Vector3d p = point - sums.planes.centre();
    const Eigen::Vector3d q = target - sums.planes.centre();
    ++sums.pairs;
    sums.from += p;
    sums.squares += (target - point).squaredNorm();
    sums.spread += p * p.transpose();
    if (normals_) {
      const Eigen::Vector3d normal = normals_->col(match).cast<double>();
      sums.planes.add(point, normal, normal.dot(target - point));
    } else {
      sums.to += q;
      sums.correlation += p * q.transpose();
    }
  }

  void require_pairs(Index found, const ClosestPairs& pairs) const {
    const Index least = normals_ ? 6 : 3;
    if (found >= least) return;
    throw Error(Fault::stage,
                fmt::format("{} of {} source points have a target point within {:.6g} m;"
                            " {} pairs are needed",
                            found, pairs.size(), options_.max_distance, least))
        .hint(
            "bring the clouds closer first (registration.planes, registration.svd), or raise "
            "max_distance");
  }

  [[nodiscard]] double error_of(const Sums& sums) const {
    return normals_ ? sums.planes.mean_square() : sums.squares / static_cast<double>(sums.pairs);
  }

  /// RMS distance of the paired points from their centroid [m].
  [[nodiscard]] static double radius_of(const Sums& sums) {
    const auto n = static_cast<double>(sums.pairs);
    return std::sqrt(std::max(0.0, sums.spread.trace() / n - (sums.from / n).squaredNorm()));
  }

  void move(const Sums& sums, IcpStep& step) {
    const Pose motion = normals_ ? sums.planes.solve(radius_of(sums), kCutoff) : fit(sums);
    const Eigen::Vector3d start = result_.pose * barycentre_;
    result_.pose = motion * result_.pose;
    result_.pose.linear() = geometry::orthonormal(result_.pose.linear());
    step.rotation = geometry::angle_of(motion.linear());
    step.translation = (motion * start - start).norm();
    ++result_.iterations;
  }

  /// The motion by singular value decomposition (thesis 3.5 to 3.11, 3.17).
  [[nodiscard]] static Pose fit(const Sums& sums) {
    const auto n = static_cast<double>(sums.pairs);
    const Eigen::Vector3d centre = sums.planes.centre();
    Pose pose = Pose::Identity();
    pose.linear() =
        geometry::best_rotation(sums.correlation / n - (sums.from / n) * (sums.to / n).transpose());
    pose.translation() = centre + sums.to / n - pose.linear() * (centre + sums.from / n);
    return pose;
  }

  void finish(const Sums& sums, const ClosestPairs& pairs) {
    result_.pairs = sums.pairs;
    result_.fitness = sums.squares / static_cast<double>(sums.pairs);
    result_.overlap = static_cast<double>(pairs.count()) / static_cast<double>(pairs.size());
    if (normals_) {
      result_.directions = sums.planes.directions(radius_of(sums));
      return;
    }
    // Point to point fixes every shift; turns are as strong as the points are spread across the
    // axis.
    NormalEquations equations(sums.planes.centre() + sums.from / static_cast<double>(sums.pairs));
    const auto n = static_cast<double>(sums.pairs);
    const geometry::Eigen3 spread =
        geometry::eigen3(sums.spread / n - (sums.from / n) * (sums.from / n).transpose());
    for (int axis = 0; axis < 3; ++axis)
      for (int normal = 0; normal < 3; ++normal)
        equations.add(equations.centre() +
                          std::sqrt(std::max(0.0, spread.values[axis])) * spread.vectors.col(axis),
                      spread.vectors.col(normal), 0.0);
    result_.directions = equations.directions(radius_of(sums));
  }

  const Cloud& source_;
  const Cloud& target_;
  const IcpOptions& options_;
  Context& context_;
  std::optional<ConstPoints> normals_;
  Eigen::Vector3d barycentre_;
  IcpResult result_;
};

}  // namespace

IcpResult icp(const Cloud& source, const Cloud& target, const Pose& start,
              const IcpOptions& options, Context& context) {
  for (const auto& [cloud, name] : {std::pair(&source, "source"), std::pair(&target, "target")})
    if (cloud->empty()) throw Error(Fault::stage, fmt::format("the {} has no points", name));
  return Icp(source, target, options, context).run(start);
}

Table history_table(const std::vector<IcpStep>& steps) {
  Table table({{"iteration", ""},
               {"pairs", ""},
               {"error", "m^2"},
               {"relative_change", ""},
               {"rotation", "rad"},
               {"translation", "m"},
               {"x", "m"},
               {"y", "m"},
               {"z", "m"}});
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const IcpStep& step = steps[k];
    table.add({static_cast<std::int64_t>(k), static_cast<std::int64_t>(step.pairs), step.error,
               step.relative_change, step.rotation, step.translation, step.barycentre.x(),
               step.barycentre.y(), step.barycentre.z()});
  }
  return table;
}

}  // namespace velum::registration
