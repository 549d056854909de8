// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <velum/cloud.hpp>
#include <velum/context.hpp>

/// What the smoothing methods of libraries have in common.
namespace velum::smoothing {

/// Middle of the bounding box: libraries work about it, so that no digits are lost far away.
Eigen::Vector3d centre_of(const Cloud& cloud);

/// Calls a library: what it throws becomes an Error of the stage that begins with `what`.
void guarded(const std::string& what, const std::function<void()>& call);

/// For libraries that report progress and stop when they are told false.
std::function<bool(double)> progress(Context& context);

/// The cloud at its new positions. Points whose new position is not finite stay where they are.
/// Records `moved_rms`, `moved_most` [m] and `unmoved`, the number of those.
Cloud moved(const Cloud& cloud, Points positions, Context& context);

}  // namespace velum::smoothing
