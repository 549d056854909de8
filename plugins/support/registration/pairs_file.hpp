// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "registration/picked_pair.hpp"

namespace velum::registration {

/// Pairs from a text file: six numbers a line (source x y z, target x y z) in units of `unit`
/// metres, separated by spaces, tabs, commas or semicolons. Empty lines and those that begin with #
/// are skipped, and so is a heading in the first line. Throws Error(Fault::input) naming the line.
std::vector<PickedPair> read_pairs(const std::filesystem::path& file, double unit);

}  // namespace velum::registration
