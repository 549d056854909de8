// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"
#include "velum/context.hpp"

namespace velum::scene {

/// What the scanner sees: a cloud in the scanner's own frame with the columns label, beam, line,
/// tilt and sensor, and time where the scanner's period is known. Beams that meet nothing within
/// reach are left out. With Effect::mixed_pixels a spot that falls on two surfaces gives a range in
/// between, labelled -1 (thesis 2.4.3.8). The noise of a beam depends on `random` and the beam's
/// number only, not on threads or on what others hit.
[[nodiscard]] Cloud scan(const Scene& scene, const Scanner& scanner, const Random& random,
                         Context& context);

}  // namespace velum::scene
