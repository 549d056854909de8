// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "velum/cloud.hpp"
#include "velum/context.hpp"

namespace velum::features {

inline constexpr Index kFpfhBins = 33;  ///< 11 each for θ, α and φ of thesis 3.4
inline constexpr Index kPfhBins = 125;  ///< 5×5×5, θ fastest

/// Which neighbours make a histogram: at most `neighbours` nearest, none beyond `radius` [m]. At
/// least one of them is set. The point itself is among its neighbours.
struct Neighbourhood {
  std::optional<Index> neighbours;
  std::optional<double> radius;
};

/// Point feature histograms (Rusu 2010; thesis 3.1.5, equation 3.4): θ, α, φ of every pair of
/// points in the neighbourhood, in per cent of the pairs; 125×N. The cloud needs unit normals; a
/// point with another normal takes no part.
Eigen::MatrixXf pfh(const Cloud& cloud, const Neighbourhood& neighbourhood, Context& context);

/// Fast point feature histograms (Rusu, Blodow, Beetz 2009; thesis 3.1.6): the pairs of each point
/// with its neighbours only, and the mean of the neighbours' histograms weighted by 1/d²; each of
/// the three parts sums to 100; 33×N. Zero where a point has no other neighbour.
Eigen::MatrixXf fpfh(const Cloud& cloud, const Neighbourhood& neighbourhood, Context& context);

/// The same histograms had every normal the other sign.
Eigen::MatrixXf mirrored_fpfh(const Eigen::MatrixXf& histograms);
Eigen::MatrixXf mirrored_pfh(const Eigen::MatrixXf& histograms);

}  // namespace velum::features
