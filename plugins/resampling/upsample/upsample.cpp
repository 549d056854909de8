// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include <cmath>

#include "border/border_points.hpp"
#include "geometry/viewpoint.hpp"
#include "mls/fit.hpp"
#include "spread.hpp"

namespace {

using velum::Cloud;
using velum::Context;
using velum::Index;
using velum::upsample::Candidate;

// A place is inside the sheet when the points around it leave no gap as wide as this: beyond the
// border, and on a straight one, the gap is 180 degrees or more.
constexpr double kInside = 2.62;  // 150 degrees
// Places are tried on a lattice this fine, of the spacing.
constexpr double kLattice = 0.5;
constexpr double kMostPlaces = 3e8;

struct Upsample {
  velum::Length spacing;
  std::optional<velum::Length> reach;
  velum::Length radius = velum::spacings(4);
  int order = 2;

  static auto about() {
    return velum::About<Upsample>(
               "Fills a sheet with points on its fitted surface, up to its border and not past it.")
        .in("cloud")
        .out("cloud", "the points given, then the new ones")
        .adds("cloud", "normals")
        .adds("cloud", "made")
        .param(&Upsample::spacing, "spacing", "wanted distance between points", velum::above(0.0))
        .required()
        .param(&Upsample::reach, "reach",
               "holes and bays wider than this stay open; unset: twice the distance to the sixth "
               "neighbour, point by point",
               velum::above(0.0))
        .param(&Upsample::radius, "radius", "neighbourhood that the surface is fitted to",
               velum::above(0.0))
        .param(&Upsample::order, "order", "order of the local polynomials", velum::between(1, 3))
        .deterministic()
        .reference("thesis 3.4: equations 3.38 to 3.40, for the surface");
  }

  Cloud operator()(const Cloud& cloud, Context& context) const {
    context.check();
    const Surfaces surfaces = fit_points(cloud, context);
    context.progress(0.2);
    const std::vector<Candidate> tried = places(cloud, surfaces, context);
    context.progress(0.6);
    const std::vector<Candidate> chosen =
        velum::upsample::spread(tried, velum::upsample::kApart * spacing, context);
    Cloud out = join(cloud, surfaces, chosen, context);
    context.measure("made", static_cast<double>(chosen.size()), "");
    context.measure("points", static_cast<double>(out.size()), "");
    return out;
  }

 private:
  // The fitted surface at every point given, and how far it reaches [m]; 0 where there is none.
  struct Surfaces {
    velum::Points foot;
    velum::Points normals;
    Eigen::VectorXf reach;
  };

  [[nodiscard]] velum::mls::FitOptions fit_options() const { return {order, radius, radius}; }

  Surfaces fit_points(const Cloud& cloud, Context& context) const {
    const auto positions = cloud.positions();
    Surfaces surfaces{positions, velum::Points(3, cloud.size()),
                      Eigen::VectorXf::Zero(cloud.size())};
    if (cloud.empty()) return surfaces;
    const velum::geometry::Viewpoints viewpoints(cloud);
    const velum::mls::Support support{positions, {}};
    cloud.neighbours().each_nearest(
        7, context, [&](Index i, std::span<const velum::Neighbour> found) {
          const float around = std::sqrt(found.back().distance2);
          surfaces.reach[i] = reach ? static_cast<float>(reach->value) : 2.0F * around;
        });
    cloud.neighbours().each_within(
        radius, context, [&](Index i, std::span<const velum::Neighbour> found) {
          const auto fit = velum::mls::fit_surface(support, positions.col(i), found, fit_options());
          const Eigen::Vector3d view = viewpoints.from(i);
          if (!fit) {
            surfaces.reach[i] = 0.0F;
            surfaces.normals.col(i) =
                (view.norm() > 0.0 ? Eigen::Vector3d(view.normalized()) : Eigen::Vector3d::UnitZ())
                    .cast<float>();
            return;
          }
          surfaces.foot.col(i) = (positions.col(i).cast<double>() + fit->step).cast<float>();
          const double side = fit->normal.dot(view) < 0.0 ? -1.0 : 1.0;
          surfaces.normals.col(i) = (side * fit->normal).cast<float>();
        });
    return surfaces;
  }

  // Places inside the sheet and away from the points given, on the tangent plane of the nearest.
  std::vector<Candidate> places(const Cloud& cloud, const Surfaces& surfaces,
                                Context& context) const {
    const double step = kLattice * spacing;
    const double count = (surfaces.reach.cast<double>().array() / step + 1.0).square().sum();
    if (!(count <= kMostPlaces))
      throw velum::Error(velum::Fault::stage,
                         "the spacing is so small that more than 300 million places would be tried")
          .hint("use a larger 'spacing' or a smaller 'reach'");
    std::vector<std::vector<Candidate>> found(static_cast<std::size_t>(cloud.size()));
    velum::parallel_for(context, cloud.size(), 64, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        context.check();
        around(cloud, surfaces, i, step, found[static_cast<std::size_t>(i)]);
      }
    });
    std::vector<Candidate> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    return all;
  }

  // Those nearer to point i than to any other.
  void around(const Cloud& cloud, const Surfaces& surfaces, Index i, double step,
              std::vector<Candidate>& places) const {
    const double wide = static_cast<double>(surfaces.reach[i]);
    const Eigen::Vector3d normal = surfaces.normals.col(i).cast<double>();
    const Eigen::Vector3d x = normal.unitOrthogonal();
    const Eigen::Vector3d y = normal.cross(x);
    const Eigen::Vector3d foot = surfaces.foot.col(i).cast<double>();
    const double apart = velum::upsample::kApart * spacing;
    const int most = static_cast<int>(0.5 * wide / step);
    thread_local std::vector<velum::Neighbour> near;
    for (int a = -most; a <= most; ++a)
      for (int b = -most; b <= most; ++b) {
        const Eigen::Vector3f at = (foot + a * step * x + b * step * y).cast<float>();
        const auto first = cloud.neighbours().nearest_one(at, wide);
        if (first.index != i) continue;
        const Eigen::Vector3f off = at - surfaces.foot.col(i);
        if (static_cast<double>(off.norm()) < apart) continue;
        cloud.neighbours().within(at, wide, near);
        if (velum::border::largest_gap(cloud.positions(), at, normal, near) < kInside)
          places.push_back({at, static_cast<std::int32_t>(i)});
      }
  }

  Cloud join(const Cloud& cloud, const Surfaces& surfaces, const std::vector<Candidate>& chosen,
             Context& context) const {
    const Index before = cloud.size();
    const auto made = static_cast<Index>(chosen.size());
    velum::Points positions(3, before + made);
    velum::Points normals(3, before + made);
    positions.leftCols(before) = cloud.positions();
    normals.leftCols(before) =
        cloud.has(velum::column::kNormals) ? velum::Points(cloud.normals()) : surfaces.normals;
    velum::Points queries(3, made);
    for (Index j = 0; j < made; ++j) queries.col(j) = chosen[static_cast<std::size_t>(j)].at;
    const velum::mls::Support support{cloud.positions(), {}};
    if (made > 0)
      cloud.neighbours().each_within(
          velum::ConstPoints(queries.data(), 3, made), radius, context,
          [&](Index j, std::span<const velum::Neighbour> found) {
            const std::int32_t owner = chosen[static_cast<std::size_t>(j)].owner;
            const auto fit = velum::mls::fit_surface(support, queries.col(j), found, fit_options());
            const Eigen::Vector3d step = fit ? fit->step : Eigen::Vector3d::Zero();
            Eigen::Vector3d normal = surfaces.normals.col(owner).cast<double>();
            if (fit)
              normal = fit->normal.dot(normal) < 0.0 ? Eigen::Vector3d(-fit->normal) : fit->normal;
            positions.col(before + j) = (queries.col(j).cast<double>() + step).cast<float>();
            normals.col(before + j) = normal.cast<float>();
          });
    return with_columns(cloud, chosen, std::move(positions), std::move(normals));
  }

  static Cloud with_columns(const Cloud& cloud, const std::vector<Candidate>& chosen,
                            velum::Points positions, velum::Points normals) {
    std::vector<std::int32_t> source(static_cast<std::size_t>(cloud.size()));
    for (std::size_t i = 0; i < source.size(); ++i) source[i] = static_cast<std::int32_t>(i);
    velum::VectorXu8 made = velum::VectorXu8::Zero(positions.cols());
    made.tail(static_cast<Index>(chosen.size())).setOnes();
    for (const Candidate& one : chosen) source.push_back(one.owner);
    return cloud.select(source)
        .with_positions(std::move(positions))
        .with(velum::column::kNormals, velum::Column(std::move(normals)))
        .with("made", velum::Column(std::move(made)));
  }
};

}  // namespace
VELUM_STAGE(Upsample)
