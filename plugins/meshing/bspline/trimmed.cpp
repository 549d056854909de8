// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "trimmed.hpp"

#include <cmath>

#include "bspline/tessellate.hpp"
#include "trimming.hpp"

namespace velum::meshing {
namespace {

using Eigen::Matrix2Xd;
using Eigen::Vector2d;

constexpr Index kFewest = 20;

Matrix2Xd to_plane(const FittedSheet& sheet) {
  Matrix2Xd plane(2, sheet.uv.cols());
  for (Index i = 0; i < plane.cols(); ++i) plane.col(i) = sheet.frame.to_plane(sheet.uv.col(i));
  return plane;
}

// The loop in parameters, within the surface's range, without points that add nothing.
Matrix2Xd to_loop(const FittedSheet& sheet, const TrimmingCurve& curve, double tolerance) {
  Matrix2Xd loop(2, curve.loop.cols());
  for (Index i = 0; i < loop.cols(); ++i)
    loop.col(i) = sheet.frame.to_uv(curve.loop.col(i)).cwiseMax(1e-6).cwiseMin(1.0 - 1e-6);
  return bspline::simplified(sheet.surface, loop, tolerance, curve.corners);
}

// A cloud that is no sail still has a border.
TrimmingCurve border_of(const Cloud& cloud, const FittedSheet& sheet, const Matrix2Xd& plane,
                        const PointOutline& outline, TrimmedSheet& made, Context& context) {
  try {
    TrimmingCurve curve = smooth_border(cloud, sheet, plane, outline);
    made.corners = true;
    return curve;
  } catch (const Error& error) {
    context.warn(std::string("no smooth border with tack, clew and head was found (") +
                 error.what() + "); the surface ends at its outermost points");
    return plain_border(plane, outline.loop);
  }
}

double length_of(const Surface& surface, const Matrix2Xd& loop) {
  const bspline::Patch patch(surface);
  double sum = 0.0;
  for (Index i = 0; i < loop.cols(); ++i) {
    const Vector2d a = loop.col(i);
    const Vector2d b = loop.col((i + 1) % loop.cols());
    const Eigen::Vector3d middle = patch.at(0.5 * (a + b));
    sum += (patch.at(a) - middle).norm() + (patch.at(b) - middle).norm();
  }
  return sum;
}

}  // namespace

TrimmedSheet trimmed_sheet(const Cloud& cloud, const TrimmedOptions& options, Context& context) {
  if (cloud.size() < kFewest)
    throw Error(Fault::stage, "the cloud has " + std::to_string(cloud.size()) +
                                  " points, a surface is fitted to at least 20");
  const FittedSheet sheet = fit_sheet(cloud, options.fit, context);
  const Matrix2Xd plane = to_plane(sheet);
  const PointOutline outline = find_outline(plane, context);
  TrimmedSheet made;
  const TrimmingCurve curve = border_of(cloud, sheet, plane, outline, made, context);
  context.progress(0.8);
  const double tolerance = 0.01 * options.size;
  made.surface = sheet.surface;
  made.surface.trimming.push_back(to_loop(sheet, curve, tolerance));
  made.holes = static_cast<Index>(outline.holes.size());
  if (options.cut_holes)
    for (const auto& hole : outline.holes)
      made.surface.trimming.push_back(to_loop(sheet, plain_border(plane, hole), tolerance));
  made.mesh = bspline::tessellate(made.surface, options.size, context).mesh;
  if (made.mesh.empty()) throw Error(Fault::stage, "the border of the points encloses no area");
  made.rms = std::sqrt(sheet.residual.squaredNorm() / static_cast<double>(cloud.size()));
  made.noise = sheet.noise;
  made.freedom = sheet.freedom;
  made.length = length_of(made.surface, made.surface.trimming.front());
  made.moved = curve.moved;
  return made;
}

}  // namespace velum::meshing
