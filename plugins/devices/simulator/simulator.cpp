// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "scene/scan.hpp"

namespace {

struct Simulator {
  velum::InputFile scene;
  std::string scanner;
  std::optional<velum::Angle> beam_step;
  std::optional<velum::Angle> tilt_step;
  std::optional<velum::Length> noise;
  bool mixed_pixels = false;

  static auto about() {
    constexpr double kLeastStep = 0.0017;  // 0.1 degrees
    return velum::About<Simulator>("What a scanner of a scene would measure.")
        .out("cloud", "in the scanner's own frame")
        .adds("cloud", "label")
        .adds("cloud", "beam")
        .adds("cloud", "line")
        .adds("cloud", "tilt")
        .adds("cloud", "sensor")
        .drops_columns()
        .param(&Simulator::scene, "scene", "the scene, a TOML file")
        .required()
        .param(&Simulator::scanner, "scanner", "name of the scanner in the scene")
        .required()
        .param(&Simulator::beam_step, "beam_step", "angle between beams; else the scene's",
               velum::at_least(kLeastStep))
        .param(&Simulator::tilt_step, "tilt_step", "angle between lines; else the scene's",
               velum::at_least(kLeastStep))
        .param(&Simulator::noise, "noise", "standard deviation of a range; else the scene's",
               velum::between(0.0, 1.0))
        .param(&Simulator::mixed_pixels, "mixed_pixels",
               "a spot that falls on two surfaces gives a range in between, labelled -1")
        .seeded()
        .reference("Canciani, thesis, 2.3.1 (LMS 511), 2.4.3.2 (noise), 2.4.3.8 (mixed pixels)");
  }

  velum::Cloud operator()(velum::Context& context) const {
    const velum::scene::Scene read = velum::scene::read_scene(scene.path);
    velum::scene::Scanner chosen = read.scanner(scanner);
    if (beam_step) chosen.beam_step = *beam_step;
    if (tilt_step) chosen.tilt_step = *tilt_step;
    if (noise) chosen.noise = *noise;
    return velum::scene::scan(read, chosen, mixed_pixels, context.random(), context);
  }
};

}  // namespace

VELUM_STAGE(Simulator)
