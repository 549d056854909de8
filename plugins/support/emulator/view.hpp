// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "emulator/mirror.hpp"
#include "emulator/plate.hpp"
#include "scene/ranges.hpp"

namespace velum::emulator {

/// What one revolution of the mirror measured, as the device numbers it.
struct Ranges {
  std::vector<std::uint16_t> distances;   ///< [mm]; 0: nothing came back
  std::vector<std::uint16_t> remissions;  ///< 1 to 254; 0: nothing came back
};

/// The scanner in its scene: ranges from beams.
class View {
 public:
  View(scene::Scene scene, const std::string& scanner, const Random& random);
  View(const View&) = delete;
  View& operator=(const View&) = delete;

  [[nodiscard]] const scene::Scanner& scanner() const { return scanner_; }
  /// The beams of revolution `number`, whose zero index passed at `start` of the device's clock
  /// [us]. Each beam has the plate's tilt at its own time.
  [[nodiscard]] Ranges look(const Mirror& mirror, const Turn& turn, const Plate& plate,
                            std::uint64_t number, double start) const;

 private:
  scene::Scene scene_;
  scene::Scanner scanner_;
  scene::RangeFinder finder_;
  Random random_;
};

}  // namespace velum::emulator
