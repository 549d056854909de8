// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "scene/scan.hpp"

namespace {

// Scanners that repeat their lines are compared in studies, which give all variants one seed: each
// has noise of its own.
velum::Random stream_of(const velum::scene::Scanner& scanner, const velum::Random& random) {
  if (scanner.repeats == 1) return random;
  std::uint64_t number = 0;
  for (const char letter : scanner.name) number = 31 * number + static_cast<unsigned char>(letter);
  return random.split(number);
}

struct Simulator {
  velum::InputFile scene;
  std::string scanner;
  std::optional<velum::Angle> beam_step;
  std::optional<velum::Angle> tilt_step;
  std::optional<velum::Length> noise;
  std::optional<std::string> errors;
  bool mixed_pixels = false;
  std::optional<int> repeats;
  std::optional<velum::Duration> period;

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
        .param(&Simulator::noise, "noise",
               "standard deviation of a range on anything; else the scene's",
               velum::between(0.0, 1.0))
        .param(&Simulator::errors, "errors",
               "what else acts on ranges: none, all, or some of material, distance, incidence, "
               "angulation, light, mixed_pixels, transparency, remission, warm_up with commas "
               "between; else the scene's")
        .param(&Simulator::mixed_pixels, "mixed_pixels",
               "a spot that falls on two surfaces gives a range in between, labelled -1")
        .param(&Simulator::repeats, "repeats", "lines at each tilt; else the scene's",
               velum::between(1, 10'000'000))
        .param(&Simulator::period, "period", "time from line to line; else the scene's",
               velum::above(0.0))
        .seeded()
        .reference("Canciani, thesis, 2.3.1 (LMS 511), 2.4.3 (errors)");
  }

  void check() const {
    velum::scene::require_scanner(scene.path, scanner, "scanner");
    try {
      if (errors) static_cast<void>(velum::scene::Effects::named(*errors));
    } catch (velum::Error& error) {
      throw std::move(error).at("errors");
    }
  }

  velum::Cloud operator()(velum::Context& context) const {
    velum::scene::Scene read = velum::scene::read_scene(scene.path);
    velum::scene::Scanner chosen = read.scanner(scanner);
    if (beam_step) chosen.beam_step = *beam_step;
    if (tilt_step) chosen.tilt_step = *tilt_step;
    if (errors) chosen.effects = velum::scene::Effects::named(*errors);
    if (mixed_pixels) chosen.effects.with(velum::scene::Effect::mixed_pixels);
    if (repeats) chosen.repeats = *repeats;
    if (period) chosen.period = *period;
    if (noise) {
      chosen.noise = *noise;
      for (auto& object : read.objects)
        if (object.material) object.material->noise = *noise;
    }
    return velum::scene::scan(read, chosen, stream_of(chosen, context.random()), context);
  }
};

}  // namespace

VELUM_STAGE(Simulator)
