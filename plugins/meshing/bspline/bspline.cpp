// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "trimmed.hpp"

namespace {

enum class Holes { bridge, cut };

struct BSpline {
  int order = 3;
  int iterations = 10;
  int refinement = 3;
  double smoothness = 1.0;
  velum::Length resolution = velum::spacings(1.0);
  Holes holes = Holes::bridge;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();

  static auto about() {
    return velum::About<BSpline>(
               "A tensor-product B-spline surface fitted to an open, noisy sheet and trimmed at "
               "its "
               "smooth border.")
        .in("cloud", "of one sheet: a sail")
        .out("surface", "u from one upright edge to the other, v from foot to head")
        .out("mesh", "of the trimmed surface")
        .param(&BSpline::order, "order", "degree of the polynomials", velum::between(2, 5))
        .param(&BSpline::iterations, "iterations", "rounds of fit and new parameters, at most",
               velum::between(1, 100))
        .param(&BSpline::refinement, "refinement",
               "rounds in which knots are added where the residuals are not those of noise",
               velum::between(0, 8))
        .param(&BSpline::smoothness, "smoothness",
               "weight of the fairing, as a multiple of the one that cross-validation finds",
               velum::between(1e-6, 1e6))
        .param(&BSpline::resolution, "resolution", "edge length of the mesh", velum::above(0.0))
        .choice(&BSpline::holes, "holes", "what becomes of places without points inside the border",
                {{"bridge", Holes::bridge, "the surface goes on over them"},
                 {"cut", Holes::cut, "they become trimming loops of their own"}})
        .param(&BSpline::up, "up", "direction from foot to head")
        .deterministic()
        .reference("Canciani, thesis, 3.5.4 and tables 3.34, 3.35 (trimmed B-spline surfaces)")
        .reference("Piegl and Tiller, The NURBS Book, 2nd edition, 1997")
        .reference("Craven and Wahba, Smoothing noisy data with spline functions, 1979")
        .reference(
            "de Silva and Tenenbaum, Sparse multidimensional scaling using landmark points, 2004")
        .licence("GPL-3.0-or-later");
  }

  std::tuple<velum::Surface, velum::Mesh> operator()(const velum::Cloud& cloud,
                                                     velum::Context& context) const {
    velum::meshing::TrimmedOptions options;
    options.fit = {order, iterations, refinement, smoothness, up};
    options.size = resolution;
    options.cut_holes = holes == Holes::cut;
    velum::meshing::TrimmedSheet made = velum::meshing::trimmed_sheet(cloud, options, context);
    context.measure("rms", made.rms, "m", velum::Better::lower);
    context.measure("noise", made.noise, "m");
    context.measure("control_points", static_cast<double>(made.surface.control.cols()), "");
    context.measure("freedom", made.freedom, "");
    context.measure("border_length", made.length, "m");
    context.measure("border_moved", made.moved, "m");
    context.measure("holes", static_cast<double>(made.holes), "");
    context.measure("corners", made.corners ? 1.0 : 0.0, "");
    if (made.moved > 0.0)
      context.info(
          "the border was moved outward by half a scan step, as a scan ends before the "
          "cloth");
    return {std::move(made.surface), std::move(made.mesh)};
  }
};

}  // namespace

VELUM_STAGE(BSpline)
