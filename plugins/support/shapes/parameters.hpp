// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>
#include <optional>
#include <velum/about.hpp>

/// Parameters that the stages which find shapes have in common.
namespace velum::shapes {

/// Describes `epsilon`, `angle` and `min_size` of a stage that has them.
template <class Stage>
AboutStage& add_tolerances(About<Stage>& about) {
  return about
      .param(&Stage::epsilon, "epsilon",
             "ε: greatest distance of a point from its shape; unset: six times the cloud's noise, "
             "at least a tenth of its spacing",
             above(0.0))
      .param(&Stage::angle, "angle", "α: greatest angle between a point's normal and the shape's",
             between(0.01, std::numbers::pi / 2))
      .param(&Stage::min_size, "min_size",
             "τ: fewer points make no shape; unset: 1 % of the cloud, at least 50", at_least(6));
}

/// The distance [m] that `epsilon` gives, or the cloud's noise where it is unset. Measures it.
double tolerance(const std::optional<Length>& epsilon, const Cloud& cloud, Context& context);

/// The number of points that `min_size` gives, or the cloud's size where it is unset.
int least_points(const std::optional<int>& min_size, const Cloud& cloud);

/// Warns where no cluster is left of a cloud that has points; `what` was sought.
void warn_of_nothing(const Clusters& clusters, std::string_view what, Index min_size,
                     double epsilon, Context& context);

}  // namespace velum::shapes
