// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>
#include <velum/about.hpp>

namespace velum::geometry {

/// Describes the parameters of a stage that grows regions over normals and curvature: `neighbours`,
/// `smoothness`, `curvature`, `min_size` and `max_size`.
template <class Stage>
AboutStage& add_growing(About<Stage>& about) {
  return about
      .param(&Stage::neighbours, "neighbours",
             "nearest points to which a region may grow from a seed, the seed among them",
             at_least(2))
      .param(&Stage::smoothness, "smoothness",
             "θ_th: greatest angle between the normals of a seed and a point that joins",
             between(0.0, std::numbers::pi / 2))
      .param(&Stage::curvature, "curvature",
             "c_th: points below it become seeds themselves; above 1/3 all do", above(0.0))
      .param(&Stage::min_size, "min_size", "N_min: smaller regions are refused", at_least(1))
      .param(&Stage::max_size, "max_size", "N_max: larger regions are refused; unset: none is",
             at_least(1));
}

}  // namespace velum::geometry
