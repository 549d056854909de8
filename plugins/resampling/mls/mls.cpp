// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <velum/stage.hpp>

#include "border/border_points.hpp"
#include "geometry/normals.hpp"
#include "geometry/thinning.hpp"
#include "geometry/viewpoint.hpp"
#include "mls/aware.hpp"

namespace {

using velum::Index;
using Found = std::span<const velum::Neighbour>;

// Points with more neighbours than this are fitted to the means of small cells, each weighted by
// its number of points: over a cell of a seventh of the radius the surface is flat and the noise
// averages the same, so nothing is lost but time.
constexpr std::size_t kMostNeighbours = 250;
constexpr double kCellsPerRadius = 7.0;

enum class Few { keep, drop };
enum class Border { plain, aware };

// The points that surfaces are fitted to, with their search index.
class Basis {
 public:
  Basis(const velum::Cloud& cloud, double radius) : cloud_(cloud) {
    if (typical_count(radius) <= kMostNeighbours) return;
    thinned_ = velum::geometry::thin(cloud.positions(), radius / kCellsPerRadius);
    index_.emplace(velum::ConstPoints(thinned_.means.data(), 3, thinned_.means.cols()));
  }

  [[nodiscard]] velum::mls::Support support() const {
    if (!index_) return {cloud_.positions(), {}};
    return {velum::ConstPoints(thinned_.means.data(), 3, thinned_.means.cols()), thinned_.counts};
  }
  void each_within(double radius, velum::Context& context,
                   const velum::Neighbours::Visitor& visit) const {
    if (index_)
      index_->each_within(cloud_.positions(), radius, context, visit);
    else
      cloud_.neighbours().each_within(radius, context, visit);
  }
  /// The same for some of the cloud's points; `visit` gets their place in `points`.
  void each_within(const std::vector<std::int32_t>& points, double radius, velum::Context& context,
                   const velum::Neighbours::Visitor& visit) const {
    velum::Points queries(3, static_cast<Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
      queries.col(static_cast<Index>(i)) = cloud_.positions().col(points[i]);
    const velum::Neighbours& index = index_ ? *index_ : cloud_.neighbours();
    index.each_within(velum::ConstPoints(queries.data(), 3, queries.cols()), radius, context,
                      visit);
  }

 private:
  // Median number of neighbours of 64 evenly chosen points.
  [[nodiscard]] std::size_t typical_count(double radius) const {
    const Index samples = std::min<Index>(cloud_.size(), 64);
    std::vector<std::size_t> counts;
    std::vector<velum::Neighbour> found;
    for (Index i = 0; i < samples; ++i) {
      cloud_.neighbours().within(cloud_.positions().col(i * cloud_.size() / samples), radius,
                                 found);
      counts.push_back(found.size());
    }
    std::nth_element(counts.begin(), counts.begin() + samples / 2, counts.end());
    return counts[static_cast<std::size_t>(samples / 2)];
  }

  const velum::Cloud& cloud_;
  velum::geometry::Thinned thinned_;
  std::optional<velum::Neighbours> index_;
};

// What one run makes of every point.
struct Smoothed {
  velum::Points positions;
  velum::Points normals;
  Eigen::VectorXf curvature;
  Eigen::VectorXd moved;           // [m]
  std::vector<std::int8_t> order;  // -1: too few neighbours
  std::vector<std::int32_t> neighbours;

  explicit Smoothed(const velum::Cloud& cloud)
      : positions(cloud.positions()),
        normals(3, cloud.size()),
        curvature(cloud.size()),
        moved(cloud.size()),
        order(static_cast<std::size_t>(cloud.size())),
        neighbours(order.size()) {}
};

struct Mls {
  velum::Length radius;
  int order = 2;
  std::optional<velum::Length> gaussian;
  Few few = Few::keep;
  Border border = Border::plain;

  static auto about() {
    return velum::About<Mls>("Moves points onto the smooth surface that their neighbours describe.")
        .in("cloud")
        .out("cloud")
        .adds("cloud", "normals")
        .adds("cloud", "curvature")
        .param(&Mls::radius, "radius", "radius of the neighbourhood", velum::above(0.0))
        .required()
        .param(&Mls::order, "order",
               "order of the local polynomials; lowered where the neighbours do not carry it, as "
               "at a border",
               velum::between(0, 3))
        .param(&Mls::gaussian, "gaussian", "h of the weight exp(−d²/h²); unset: the radius",
               velum::above(0.0))
        .advanced()
        .choice(&Mls::few, "few", "what becomes of points whose neighbours fix no plane",
                {{"keep", Few::keep, "they stay where they are"},
                 {"drop", Few::drop, "they are removed"}})
        .choice(&Mls::border, "border", "what is done where neighbours lie on one side",
                {{"plain", Border::plain, "the order is lowered where the noise asks for it"},
                 {"aware", Border::aware,
                  "the neighbourhood is widened inwards up to 2.8 times as far as the "
                  "surface allows, narrowed where it bends, and points go back along the ray that "
                  "they were seen by; adds the column border"}})
        .deterministic()
        .reference("thesis 3.4: equations 3.38 to 3.40")
        .reference("D. Levin, Mesh-Independent Surface Interpolation (2004)")
        .reference(
            "A. Goldenshluger and A. Nemirovski, On spatially adaptive estimation of nonparametric "
            "regression, Mathematical Methods of Statistics 6 (1997): border = aware");
  }

  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    context.check();
    Smoothed result(cloud);
    if (!cloud.empty()) smooth(cloud, context, result);
    report(result, context);
    std::vector<std::uint8_t> at_border;
    if (border == Border::aware) {
      at_border = velum::border::border_points(cloud, context);
      report_border(at_border, result.moved, context);
    }
    velum::Cloud out =
        cloud.with_positions(std::move(result.positions))
            .with(velum::column::kNormals, velum::Column(std::move(result.normals)))
            .with(velum::column::kCurvature, velum::Column(std::move(result.curvature)));
    if (border == Border::aware)
      out = out.with("border", velum::Column(velum::VectorXu8(Eigen::Map<const velum::VectorXu8>(
                                   at_border.data(), out.size()))));
    return few == Few::drop ? without_few(out, result.order) : out;
  }

 private:
  void smooth(const velum::Cloud& cloud, velum::Context& context, Smoothed& result) const {
    const Basis basis(cloud, radius);
    const velum::mls::Support support = basis.support();
    const velum::geometry::Viewpoints viewpoints(cloud);
    const velum::mls::FitOptions options{order, radius, gaussian ? *gaussian : radius};
    const bool aware = border == Border::aware;
    const double noise = aware ? velum::geometry::estimate_noise(cloud, context) : 0.0;
    const auto positions = cloud.positions();
    std::vector<std::uint8_t> widen(result.order.size(), 0);
    basis.each_within(radius, context, [&](Index i, Found found) {
      const Eigen::Vector3f point = positions.col(i);
      const auto slot = static_cast<std::size_t>(i);
      result.neighbours[slot] = static_cast<std::int32_t>(found.size());
      auto surface = velum::mls::fit_surface(support, point, found, options);
      if (aware && surface && velum::mls::one_sided(*surface, options)) widen[slot] = 1;
      if (aware && surface && widen[slot] == 0)
        surface = velum::mls::fit_aware(support, point, found, options, 1.0, noise);
      place(cloud, i, surface, viewpoints.from(i), noise, result);
    });
    std::vector<std::int32_t> wide;
    for (std::size_t i = 0; i < widen.size(); ++i)
      if (widen[i] != 0) wide.push_back(static_cast<std::int32_t>(i));
    if (wide.empty()) return;
    basis.each_within(wide, velum::mls::kWidest * radius, context, [&](Index query, Found found) {
      const Index i = wide[static_cast<std::size_t>(query)];
      const auto surface = velum::mls::fit_aware(support, positions.col(i), found, options,
                                                 velum::mls::kWidest, noise);
      place(cloud, i, surface, viewpoints.from(i), noise, result);
    });
  }

  // Puts point i on `surface`.
  void place(const velum::Cloud& cloud, Index i,
             const std::optional<velum::mls::LocalSurface>& surface, const Eigen::Vector3d& view,
             double noise, Smoothed& result) const {
    if (!surface) {
      keep(cloud, i, view, result);
      return;
    }
    const bool by_ray = border == Border::aware && cloud.sensor_of(i) && view.norm() > 0.0;
    const Eigen::Vector3d step =
        by_ray ? velum::mls::step_along_ray(*surface, view, noise) : surface->step;
    const double side = surface->normal.dot(view) < 0.0 ? -1.0 : 1.0;
    result.positions.col(i) = (cloud.positions().col(i).cast<double>() + step).cast<float>();
    result.normals.col(i) = (side * surface->normal).cast<float>();
    result.curvature[i] = static_cast<float>(surface->curvature);
    result.moved[i] = step.norm();
    result.order[static_cast<std::size_t>(i)] = static_cast<std::int8_t>(surface->order);
  }

  // A point without a surface keeps what it has; a normal that it has not is the way to the sensor.
  static void keep(const velum::Cloud& cloud, Index i, const Eigen::Vector3d& view,
                   Smoothed& result) {
    const bool seen = view.norm() > 0.0;
    if (cloud.has(velum::column::kNormals))
      result.normals.col(i) = cloud.normals().col(i);
    else
      result.normals.col(i) =
          (seen ? Eigen::Vector3d(view.normalized()) : Eigen::Vector3d::UnitZ()).cast<float>();
    result.curvature[i] = cloud.has(velum::column::kCurvature) ? cloud.curvature()[i] : 0.0F;
    result.moved[i] = 0.0;
    result.order[static_cast<std::size_t>(i)] = -1;
  }

  static void report_border(const std::vector<std::uint8_t>& at_border,
                            const Eigen::VectorXd& moved, velum::Context& context) {
    double squares = 0.0, count = 0.0;
    for (std::size_t i = 0; i < at_border.size(); ++i) {
      if (at_border[i] == 0) continue;
      const double step = moved[static_cast<Index>(i)];
      squares += step * step;
      count += 1.0;
    }
    context.measure("border_points", count, "");
    context.measure("border_moved_rms", count > 0.0 ? std::sqrt(squares / count) : 0.0, "m");
  }

  static velum::Cloud without_few(const velum::Cloud& cloud,
                                  const std::vector<std::int8_t>& order) {
    std::vector<std::int32_t> kept;
    for (std::size_t i = 0; i < order.size(); ++i)
      if (order[i] >= 0) kept.push_back(static_cast<std::int32_t>(i));
    return kept.size() == order.size() ? cloud : cloud.select(kept);
  }

  void report(const Smoothed& result, velum::Context& context) const {
    const auto count = static_cast<double>(std::max<std::size_t>(result.order.size(), 1));
    double neighbours = 0.0;
    for (const std::int32_t n : result.neighbours) neighbours += n;
    const auto lowered = std::count_if(result.order.begin(), result.order.end(),
                                       [&](int used) { return used >= 0 && used < order; });
    const auto left = std::count(result.order.begin(), result.order.end(), std::int8_t{-1});
    context.measure("moved_rms", std::sqrt(result.moved.squaredNorm() / count), "m");
    context.measure("moved_most", result.moved.size() > 0 ? result.moved.maxCoeff() : 0.0, "m");
    context.measure("neighbours", neighbours / count, "");
    context.measure("lowered", static_cast<double>(lowered), "");
    context.measure("few", static_cast<double>(left), "", velum::Better::lower);
    if (left > 0)
      context.warn(fmt::format(
          "{} of {} points have neighbours within the radius that fix no "
          "plane; they {}",
          left, result.order.size(), few == Few::keep ? "stay where they are" : "are removed"));
  }
};

}  // namespace
VELUM_STAGE(Mls)
