// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/cloud.hpp>

#include "trim.hpp"

namespace velum::meshing {

/// Parameters of PCL's Poisson reconstruction, by its names.
struct PoissonRules {
  int depth = 8;
  int solver_divide = 8;
  int iso_divide = 8;
  double scale = 1.1;
  double samples_per_node = 1.0;
  double point_weight = 4.0;
};

/// The closed surface around the cloud, which has unit normals and an extent.
Draft poisson_surface(const Cloud& cloud, const PoissonRules& rules);

}  // namespace velum::meshing
