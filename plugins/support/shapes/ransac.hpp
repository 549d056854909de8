// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>
#include <velum/cloud.hpp>

#include "shapes/shape.hpp"

namespace velum::shapes {

struct Search {
  std::vector<Kind> kinds;
  double epsilon = 0.0;  ///< ε: greatest distance of a point from its shape [m]
  double angle = 0.35;   ///< α: greatest angle between the point's and the shape's normal [rad]
  Index min_size = 1;    ///< τ: fewer points make no shape
  int most = std::numeric_limits<int>::max();  ///< shapes to be found
  double overlook = 0.01;  ///< probability of missing a shape of min_size points
  double max_radius = std::numeric_limits<double>::infinity();  ///< of spheres and cylinders [m]
  double gap = 0.0;   ///< a wider gap parts a shape: the largest part is taken [m]; 0: never
  bool edges = true;  ///< points with mixed normals join the shape that they lie on
};

struct Found {
  Shape shape;          ///< relative to the cloud's origin
  Index points = 0;     ///< that carry its label
  Index consensus = 0;  ///< that agreed with it in distance and normal when it was found
  double rms = 0.0;     ///< of the points' distances [m]
};

struct Detection {
  std::vector<Found> shapes;  ///< by points, the most first
  Eigen::VectorXi labels;     ///< index into shapes, or -1
  Index samples = 0;          ///< drawn in all
};

/// Basic shapes one after another by RANSAC (thesis 3.3.2, Algorithm 3.4; Schnabel et al. 2007):
/// samples drawn locally, candidates checked by their normals, scored on growing subsets of the
/// points until one is surely best, refitted to all that agree, and its points taken out. In the
/// end every point is given to the shape it fits best, by distance in units of the shape's own
/// scatter and by normal. Needs `normals`. The result depends on `random`, not on the threads.
Detection find_shapes(const Cloud& cloud, const Search& search, Context& context);

/// The last step alone: labels for these shapes (which are refitted), whose number, points, rms
/// and order may change.
void assign_points(const Cloud& cloud, const Search& search, Detection& detection,
                   Context& context);

}  // namespace velum::shapes
