// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <velum/context.hpp>

#include "draft.hpp"

namespace velum::meshing {

/// What OpenMesh is asked to do, in this order.
struct RefineRules {
  double min_angle = 0.0;           ///< triangles with a smaller one are slivers [rad]
  std::optional<Index> target;      ///< triangles to be left; unset: as many as the error allows
  std::optional<double> max_error;  ///< farthest that a removed vertex may be from the mesh [m]
  int smooth = 0;                   ///< rounds of smoothing
};

struct Refined {
  Index slivers = 0;  ///< collapsed, flipped or deleted
  Index refused = 0;  ///< triangles that do not fit into a manifold mesh
};

/// Removes slivers: the short edge of a needle is collapsed, the long edge of a cap flipped, or, on
/// the border, its triangle deleted.
Refined remove_slivers(Draft& draft, const RefineRules& rules, Context& context);

/// Removes vertices by quadric error, then smooths. Vertices on borders stay where they are.
Refined decimate_and_smooth(Draft& draft, const RefineRules& rules, Context& context);

}  // namespace velum::meshing
