// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/sail.hpp"
#include "velum/values.hpp"

namespace velum::scene {

/// The sail as an untrimmed bicubic B-spline, u from luff to leech and v from foot to head, moved
/// by `motion`. It interpolates the sail at its Greville points; in between it is within 0.05 mm
/// for sails whose sections are given at heights a tenth or more apart.
[[nodiscard]] Surface surface_of(const Sail& sail, const Pose& motion);

}  // namespace velum::scene
