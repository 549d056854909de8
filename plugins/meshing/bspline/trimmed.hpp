// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "fitted.hpp"

namespace velum::meshing {

struct TrimmedOptions {
  SheetOptions fit;
  double size = 0.0;       ///< edge length of the mesh [m]
  bool cut_holes = false;  ///< holes become trimming loops of their own
};

struct TrimmedSheet {
  Surface surface;
  Mesh mesh;
  double rms = 0.0;  ///< of the residuals [m]
  double noise = 0.0;
  double freedom = 0.0;
  double length = 0.0;  ///< of the outer border [m]
  double moved = 0.0;   ///< usual outward move of its points [m]
  Index holes = 0;
  bool corners = false;  ///< were tack, clew and head found?
};

/// The whole way from a cloud to a trimmed surface and its mesh.
[[nodiscard]] TrimmedSheet trimmed_sheet(const Cloud& cloud, const TrimmedOptions& options,
                                         Context& context);

}  // namespace velum::meshing
