// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>

#include "scene/keys.hpp"
#include "scene/scene.hpp"

/// The parts of a scene file, each read from its table. All throw Error (Fault::input) with the
/// place of the mistake.
namespace velum::scene {

using Frames = std::map<std::string, Pose, std::less<>>;
using Materials = std::map<std::string, Material, std::less<>>;

/// The frame that the key `frame` names; the scene's own without it.
[[nodiscard]] Pose frame_of(Keys& keys, const Frames& frames);
/// The material that the key `material` names: one of the file, else a known one.
[[nodiscard]] Material material_of(Keys& keys, const Materials& materials);
/// [material.name]: a material `like` another one, with other numbers.
[[nodiscard]] Material read_material(const SceneFile& file, const Entry& entry,
                                     const Materials& materials);
[[nodiscard]] Sun read_sun(const SceneFile& file, const Node& table);
[[nodiscard]] Scanner read_scanner(const SceneFile& file, const Entry& entry, const Frames& frames);

}  // namespace velum::scene
