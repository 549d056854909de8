// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "fitted.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "bspline/fit.hpp"
#include "bspline/refine.hpp"
#include "geometry/thinning.hpp"
#include "geometry/viewpoint.hpp"
#include "knots.hpp"
#include "unroll.hpp"

namespace velum::meshing {
namespace {

using bspline::Along;
using bspline::Sparse;
using Eigen::Matrix2Xd;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr Index kUnrolled = 4000;      // points that are laid flat; the others follow
constexpr double kLeastCosine = 0.25;  // noise at grazing rays is not trusted to vanish
constexpr double kSpans = 7.0;         // to begin with, along a square sheet
constexpr int kSeeking = 3;            // rounds in which the roughness' weight is sought
constexpr double kStiffer = 30.0;      // the first surface must not fold
constexpr double kOutlier = 4.0;       // of the usual residual: counts half

// The plane with `up` as its y axis, seen from the side of the sensors.
void orient(Matrix2Xd& plane, const Points& points, const Vector3d& up, const Vector3d& view) {
  const Vector2d mean = plane.rowwise().mean();
  plane.colwise() -= mean;
  const Matrix3Xd space =
      points.cast<double>().colwise() - Vector3d(points.cast<double>().rowwise().mean());
  const Eigen::Matrix2d spread = plane * plane.transpose();
  const Eigen::Matrix<double, 3, 2> map = space * plane.transpose() * spread.inverse();
  const double length = up.norm();
  if (length > 0.0) {
    const Vector2d rise = map.transpose() * up / length;
    // A level sheet keeps its longest direction as y.
    if (rise.norm() > 0.1) {
      const Vector2d y = rise.normalized();
      Eigen::Matrix2d turn;
      turn << y.y(), -y.x(), y.x(), y.y();
      plane = (turn * plane).eval();
      if (turn.determinant() * map.col(0).cross(map.col(1)).dot(view) < 0.0) plane.row(0) *= -1.0;
      return;
    }
  }
  if (map.col(0).cross(map.col(1)).dot(view) < 0.0) plane.row(0) *= -1.0;
}

Surface grid(const SheetFrame& frame, int degree) {
  Surface surface;
  surface.degree_u = surface.degree_v = degree;
  const double aspect = frame.width() / frame.height();
  const auto spans = [](double wanted) {
    return std::clamp<Index>(static_cast<Index>(std::lround(wanted)), 3, 12);
  };
  surface.knots_u = bspline::uniform_knots(degree, spans(kSpans * std::sqrt(aspect)));
  surface.knots_v = bspline::uniform_knots(degree, spans(kSpans / std::sqrt(aspect)));
  return surface;
}

// A fit of all three coordinates at the places in the plane: where the rounds begin.
Surface first_fit(const SheetFrame& frame, const Matrix2Xd& plane, const Points& points,
                  int degree) {
  Surface surface = grid(frame, degree);
  Matrix2Xd uv(2, plane.cols());
  for (Index i = 0; i < plane.cols(); ++i) uv.col(i) = frame.to_uv(plane.col(i));
  const Vector3d centre = points.cast<double>().rowwise().mean();
  const Matrix3Xd targets = points.cast<double>().colwise() - centre;
  const auto fit = bspline::smooth_fit(
      bspline::design(surface, uv), targets.transpose(), VectorXd::Ones(uv.cols()),
      bspline::roughness(surface, frame.width(), frame.height(), 2), Eigen::MatrixXd(), kStiffer);
  surface.control = fit.coefficients.transpose().colwise() + centre;
  return surface;
}

class Fitter {
 public:
  Fitter(const Cloud& cloud, const SheetOptions& options, Context& context, FittedSheet& sheet)
      : positions_(cloud.positions()),
        views_(cloud),
        seen_(!cloud.sensors().empty()),
        options_(options),
        context_(context),
        sheet_(sheet),
        base_(sheet.surface),
        normals_(3, cloud.size()),
        weights_(VectorXd::Ones(cloud.size())) {
    sheet_.residual.resize(cloud.size());
  }

  void run() {
    project();
    int refined = 0;
    for (int round = 0; round < options_.iterations; ++round) {
      sheet_.rounds = round + 1;
      const double moved = improve();
      project();
      if (moved > 0.1 * sheet_.noise) continue;
      if (refined >= options_.refinement || !refine()) break;
      ++refined;
      lambda_.reset();
      relax_ = 1.0;
      moved_ = std::numeric_limits<double>::infinity();
      seeking_ = kSeeking;
    }
    context_.progress(0.7);
  }

 private:
  // Nearest places, normals and residuals of all points.
  void project() {
    const bspline::Patch patch(sheet_.surface);
    parallel_for(context_, positions_.cols(), 256, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        const Vector3d p = positions_.col(i).cast<double>();
        sheet_.uv.col(i) = patch.project(p, sheet_.uv.col(i));
        const bspline::Derivatives d = patch.derivatives(sheet_.uv.col(i));
        normals_.col(i) = d.normal();
        sheet_.residual[i] = normals_.col(i).dot(p - d.point);
      }
    });
  }

  // Range noise moves a point along its ray; off the surface it counts with the cosine.
  void weigh() {
    const Index n = positions_.cols();
    VectorXd scatter = VectorXd::Ones(n);
    if (seen_)
      for (Index i = 0; i < n; ++i)
        scatter[i] =
            std::max(kLeastCosine, std::abs(normals_.col(i).dot(views_.from(i).normalized())));
    std::vector<double> sizes(static_cast<std::size_t>(n));
    for (Index i = 0; i < n; ++i)
      sizes[static_cast<std::size_t>(i)] = std::abs(sheet_.residual[i]) / scatter[i];
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    const double usual = 1.4826 * *middle;
    for (Index i = 0; i < n; ++i) {
      const double ratio =
          usual > 0.0 ? std::abs(sheet_.residual[i]) / (scatter[i] * kOutlier * usual) : 0.0;
      weights_[i] =
          1.0 / (scatter[i] * scatter[i] * (1.0 + (seeking_ > 1 ? 0.0 : std::pow(ratio, 4))));
    }
    weights_ *= static_cast<double>(n) / weights_.sum();
  }

  // Normals where the control points belong: those of the first, stiff surface, which cannot fold.
  [[nodiscard]] Matrix3Xd control_normals() const {
    const Surface& s = sheet_.surface;
    const bspline::Patch patch(base_);
    const VectorXd u = bspline::greville(s.knots_u, s.degree_u);
    const VectorXd v = bspline::greville(s.knots_v, s.degree_v);
    Matrix3Xd normals(3, s.control.cols());
    for (Index i = 0; i < u.size(); ++i)
      for (Index j = 0; j < v.size(); ++j)
        normals.col(i * v.size() + j) = patch.derivatives({u[i], v[j]}).normal();
    return normals;
  }

  // One step of control points along the normals; the RMS move of the surface at the points [m].
  double improve() {
    context_.check();
    weigh();
    Surface& s = sheet_.surface;
    const Matrix3Xd out = control_normals();
    Sparse design = bspline::design(s, sheet_.uv);
    for (Index k = 0; k < design.outerSize(); ++k)
      for (Sparse::InnerIterator it(design, k); it; ++it)
        it.valueRef() *= normals_.col(it.row()).dot(out.col(k));
    const Sparse rough = bspline::roughness(s, sheet_.frame.width(), sheet_.frame.height(), 3);
    const Vector3d centre = s.control.rowwise().mean();
    const Matrix3Xd centred = s.control.colwise() - centre;
    const Eigen::MatrixXd bent = rough * centred.transpose();
    VectorXd load(out.cols());
    for (Index k = 0; k < load.size(); ++k) load[k] = bent.row(k).dot(out.col(k));
    Sparse penalty = rough;
    for (Index k = 0; k < penalty.outerSize(); ++k)
      for (Sparse::InnerIterator it(penalty, k); it; ++it)
        it.valueRef() *= out.col(it.row()).dot(out.col(k));
    context_.check();
    const bspline::Smoothed fit = bspline::smooth_fit(design, sheet_.residual, weights_, penalty,
                                                      load, options_.smoothness, lambda_);
    // Sought anew in every round, the balance would keep the surface moving.
    if (seeking_ > 0 && --seeking_ == 0) lambda_ = fit.lambda;
    const VectorXd step = fit.coefficients.col(0);
    for (Index k = 0; k < step.size(); ++k) s.control.col(k) += relax_ * step[k] * out.col(k);
    const auto n = static_cast<double>(positions_.cols());
    sheet_.freedom = fit.freedom;
    sheet_.noise = std::sqrt(fit.squares / std::max(1.0, n - fit.freedom));
    const double moved = std::sqrt((design * step).squaredNorm() / n);
    // A far point, seen at a grazing angle, may swing from round to round.
    if (moved > 0.6 * moved_) relax_ = std::max(0.2, 0.6 * relax_);
    moved_ = moved;
    return moved;
  }

  // Halves the spans in which the residuals of neighbouring points agree too well to be noise.
  bool refine() {
    Surface& s = sheet_.surface;
    const std::vector<double> u = spans_to_halve(sheet_, weights_, Along::u);
    const std::vector<double> v = spans_to_halve(sheet_, weights_, Along::v);
    for (const double at : u) bspline::insert_knot(s, Along::u, at);
    for (const double at : v) bspline::insert_knot(s, Along::v, at);
    sheet_.knots_added += static_cast<int>(u.size() + v.size());
    return !u.empty() || !v.empty();
  }

  ConstPoints positions_;
  geometry::Viewpoints views_;
  bool seen_;
  const SheetOptions& options_;
  Context& context_;
  FittedSheet& sheet_;
  Surface base_;
  Matrix3Xd normals_;
  VectorXd weights_;
  std::optional<double> lambda_;
  double relax_ = 1.0;  // share of each step that is made
  double moved_ = std::numeric_limits<double>::infinity();
  int seeking_ = kSeeking;  // rounds
};

Vector3d mean_view(const Cloud& cloud) {
  const geometry::Viewpoints views(cloud);
  Vector3d sum = Vector3d::Zero();
  for (Index i = 0; i < cloud.size(); ++i) {
    const Vector3d view = views.from(i);
    if (view.norm() > 0.0) sum += view.normalized();
  }
  return sum;
}

}  // namespace

FittedSheet fit_sheet(const Cloud& cloud, const SheetOptions& options, Context& context) {
  const ConstPoints positions = cloud.positions();
  const double cell = cloud.size() > kUnrolled ? geometry::cell_for(positions, kUnrolled) : 0.0;
  Points points = positions;
  std::vector<std::int32_t> nearest(static_cast<std::size_t>(cloud.size()));
  for (std::size_t i = 0; i < nearest.size(); ++i) nearest[i] = static_cast<std::int32_t>(i);
  if (cell > 0.0) {
    geometry::Thinned thinned = geometry::thin(positions, cell);
    points = std::move(thinned.means);
    nearest = std::move(thinned.cell_of);
  }
  Matrix2Xd plane = unroll(points, context);
  context.progress(0.2);
  orient(plane, points, options.up, mean_view(cloud));
  const Vector2d extent = plane.rowwise().maxCoeff() - plane.rowwise().minCoeff();
  FittedSheet sheet;
  sheet.frame = SheetFrame(
      plane, Vector2d(0.02, 0.04).cwiseProduct(extent) + Vector2d::Constant(2.0 * cloud.spacing()));
  sheet.surface = first_fit(sheet.frame, plane, points, options.degree);
  sheet.surface.origin = cloud.origin();
  sheet.surface.sensors = cloud.sensors();
  sheet.uv.resize(2, cloud.size());
  for (Index i = 0; i < cloud.size(); ++i)
    sheet.uv.col(i) = sheet.frame.to_uv(plane.col(nearest[static_cast<std::size_t>(i)]));
  Fitter(cloud, options, context, sheet).run();
  return sheet;
}

}  // namespace velum::meshing
