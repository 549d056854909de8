// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "sail/shape.hpp"

#include <cmath>
#include <numbers>

#include "sail/cloth.hpp"
#include "sail/section.hpp"

namespace velum::sail {
namespace {

using Eigen::Vector3d;

double area_of(const Sheet& sheet) {
  const auto triangles = sheet.mesh.triangles();
  double sum = 0.0;
  for (Index i = 0; i < triangles.cols(); ++i) {
    const Vector3d a = sheet.points.col(triangles(0, i));
    const Vector3d b = sheet.points.col(triangles(1, i));
    const Vector3d c = sheet.points.col(triangles(2, i));
    sum += 0.5 * (b - a).cross(c - a).norm();
  }
  return sum;
}

// Angles count to leeward, which is the side that most of the camber is on.
std::vector<Section> to_leeward(const std::vector<RawSection>& raw) {
  double bulge = 0.0;
  for (const RawSection& one : raw) bulge += one.bulge;
  const double sign = bulge < 0.0 ? -1.0 : 1.0;
  std::vector<Section> sections;
  for (const RawSection& one : raw) {
    Section section = one.values;
    section.angle = sign * std::remainder(section.angle, 2.0 * std::numbers::pi);
    sections.push_back(section);
  }
  return sections;
}

Shape shape_of(const Border& border, const Frame& frame, std::vector<RawSection> raw,
               const std::vector<double>& heights) {
  for (std::size_t i = 0; i < raw.size(); ++i) {
    raw[i].values.height = heights[i];
    raw[i].values.z += frame.datum();
  }
  Shape shape;
  shape.sections = to_leeward(raw);
  shape.luff = border.luff.length();
  shape.leech = border.leech.length();
  shape.foot = border.foot.length();
  shape.top = border.top.length();
  shape.tack = frame.true_position(border.tack());
  shape.clew = frame.true_position(border.clew());
  shape.head = frame.true_position(border.head());
  shape.peak = frame.true_position(border.peak());
  return shape;
}

// Of the sections, in sail axes.
std::vector<double> levels(const Border& border, const std::vector<double>& heights) {
  const double base = border.tack().z();
  std::vector<double> all;
  for (const double height : heights) all.push_back(base + height * (border.head().z() - base));
  return all;
}

}  // namespace

Shape measure(const Mesh& mesh, const Vector3d& up, const Vector3d& bow, const Options& options,
              Context& context) {
  const Sheet sheet = make_sheet(mesh, up, bow);
  context.check();
  const Outline outline = find_corners(sheet.border(), sheet.spacing);
  context.check();
  const Border border =
      make_border(outline, options.compensate ? edge_of_scan(sheet, outline) : edge_as_is(outline));
  const double band = options.band * (border.head().z() - border.tack().z());
  std::vector<RawSection> raw;
  for (const double z : levels(border, options.heights)) {
    context.check();
    raw.push_back(fit_section(sheet, border, z, band, options.tangent));
  }
  Shape shape = shape_of(border, sheet.frame, std::move(raw), options.heights);
  const double strip = strip_area(sheet, outline, border);
  shape.area = area_of(sheet) + strip;
  shape.moved = strip / (shape.luff + shape.leech + shape.foot + shape.top);
  return shape;
}

Shape measure(const Surface& surface, const Vector3d& up, const Vector3d& bow,
              const std::vector<double>& heights, Context& context) {
  const Cloth cloth(surface, up, bow, context);
  const Border border = cloth.border();
  std::vector<RawSection> raw;
  for (const double z : levels(border, heights)) {
    context.check();
    raw.push_back(cloth.section(z));
  }
  Shape shape = shape_of(border, cloth.frame(), std::move(raw), heights);
  shape.area = cloth.area(context);
  return shape;
}

}  // namespace velum::sail
