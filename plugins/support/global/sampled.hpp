// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "velum/cloud.hpp"
#include "velum/context.hpp"

namespace velum::registration {

/// A cloud thinned to one point a cell, with normals and features; positions relative to the
/// cloud's origin.
struct Sampled {
  Cloud cloud;                     ///< with normals, of consistent sign within each sheet
  Eigen::MatrixXf features;        ///< a column for each key
  std::vector<std::int32_t> keys;  ///< points whose surroundings are least common
  double cell = 0.0;               ///< [m]
  std::vector<float> rarity;       ///< of each point, as rarity() has it; none with PFH
};

struct SampleOptions {
  double cell = 0.0;           ///< [m]
  double normal_cells = 2.5;   ///< radius of the normals, in cells
  double feature_cells = 5.0;  ///< radius of the features, in cells
  Index keys = 2500;
  bool full = false;  ///< PFH instead of FPFH
};

Sampled sample(const Cloud& cloud, const SampleOptions& options, Context& context);

/// How much each of FPFH's columns tells: the inverse of the share of all columns that look like it
/// from either side, 1 where these are few. A floor lies on a floor in many ways.
std::vector<float> rarity(const Eigen::MatrixXf& fpfh, Context& context);

/// Turns normals so that neighbours agree, starting at each sheet's least curved point: the sign
/// that a sensor would give is lost where nobody says where it stood. `neighbours` of each point.
void agree_on_sign(const Cloud& cloud, Points& normals, Index neighbours, Context& context);

}  // namespace velum::registration
