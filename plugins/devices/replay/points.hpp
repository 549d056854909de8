// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <velum/cloud.hpp>
#include <velum/context.hpp>

/// The text files of the thesis's acquisition program: a point a line, x y z, in the scanner's
/// frame and in the order in which the beams came.
namespace velum::replay {

/// Does the file begin with lines of numbers?
bool is_points(const std::filesystem::path& path);

/// The points with the columns beam, line, tilt, range and sensor, which their places tell: a plate
/// that turns about x puts a beam at angle φ and tilt τ (within ±90°) at r (cos φ, sin φ cos τ,
/// sin φ sin τ). A line ends where φ falls back; beams count the returns of their line, since those
/// without one are not in the file. `unit` is that of the file's lengths [m].
Cloud read_points(const std::filesystem::path& path, double unit, const std::string& sensor,
                  Context& context);

}  // namespace velum::replay
