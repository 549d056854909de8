// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "velum/cloud.hpp"
#include "velum/random.hpp"

namespace velum::registration {

/// A share of the points of `cloud`, at least `least` of them while there are as many, ascending:
/// each as likely as any other.
std::vector<std::int32_t> random_sample(const Cloud& cloud, double share, Index least,
                                        Random random);

/// The same with points the likelier the more the surface bends there: in proportion to
/// `curvature`, but at least a tenth of its mean, so that even parts are not lost altogether.
/// Needs the `curvature` column.
std::vector<std::int32_t> curvature_sample(const Cloud& cloud, double share, Index least,
                                           Random random);

}  // namespace velum::registration
