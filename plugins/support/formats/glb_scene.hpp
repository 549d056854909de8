// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "formats/glb_document.hpp"

namespace velum::formats {

/// A mesh of the file as a node of its scene places it, in the file's axes [m].
struct GlbInstance {
  std::size_t mesh = 0;
  Eigen::Affine3d pose = Eigen::Affine3d::Identity();
};

/// The meshes of the file's scene, nodes in the order of the file. Throws Error (Fault::input)
/// where nodes are no tree, or a mesh moves with a skeleton.
std::vector<GlbInstance> instances_of(const GlbDocument& document);

}  // namespace velum::formats
