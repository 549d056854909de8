// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/context.hpp>

#include "bspline/evaluate.hpp"
#include "frame.hpp"

namespace velum::meshing {

struct SheetOptions {
  int degree = 3;
  int iterations = 10;  ///< of fit and reparameterisation
  int refinement = 3;   ///< rounds of added knots
  double smoothness = 1.0;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
};

/// A smooth surface through a cloud that scatters about it.
struct FittedSheet {
  Surface surface;  ///< untrimmed, over [0, 1]²
  SheetFrame frame;
  Eigen::Matrix2Xd uv;       ///< the place nearest to each point
  Eigen::VectorXd residual;  ///< of each point, along the normal [m]
  double noise = 0.0;        ///< RMS residual, corrected for the parameters used [m]
  double freedom = 0.0;      ///< effective number of parameters
  int rounds = 0;
  int knots_added = 0;
};

/// Unrolls the cloud, gives it parameters from its shape, and fits. Each round moves the control
/// points along the surface's normals so that squared distances plus roughness are least, weighted
/// for range noise (which acts along the ray) and against outliers; then every point gets the
/// parameters of its nearest place. When that has settled, spans whose residuals are not those of
/// noise are halved. Throws Error (Fault::stage) when the points make no surface.
[[nodiscard]] FittedSheet fit_sheet(const Cloud& cloud, const SheetOptions& options,
                                    Context& context);

}  // namespace velum::meshing
