// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <cmath>
#include <numbers>
#include <velum/stage.hpp>

#include "emulator/server.hpp"

namespace {

using velum::emulator::FaultKind;
using velum::lms511::Mode;

constexpr double kDegree = std::numbers::pi / 180.0;

struct Emulator {
  velum::InputFile scene;
  std::string scanner;
  std::string address = "127.0.0.1";
  int port = velum::lms511::kAsciiPort;
  double frequency = 25.0;
  std::optional<velum::Angle> resolution;
  std::optional<double> tilt_speed;
  double encoder_counts = 3'600'000.0;
  double encoder_zero = 2'000'000.0;
  std::optional<velum::Length> noise;
  std::optional<std::string> errors;
  int serial = 18000001;
  double speed = 1.0;
  velum::Duration lifetime{0.0};
  int sessions = 0;
  FaultKind fault = FaultKind::none;
  int fault_after = 20;
  int fault_code = 13;

  static auto about();
  void check() const;
  void operator()(velum::Context& context) const;

 private:
  [[nodiscard]] velum::scene::Scene read() const;
  [[nodiscard]] Mode mode(const velum::scene::Scanner& chosen) const;
  [[nodiscard]] velum::emulator::Device device(const Mode& mode) const;
  [[nodiscard]] velum::emulator::Plate plate(const velum::scene::Scanner& chosen,
                                             const Mode& mode) const;
  [[nodiscard]] velum::emulator::ServerOptions options() const;
};

auto Emulator::about() {
  return velum::About<Emulator>("A SICK LMS 511 on TCP, made of a scene: answers and streams.")
      .param(&Emulator::scene, "scene", "the scene, a TOML file")
      .required()
      .param(&Emulator::scanner, "scanner",
             "name of the scanner in the scene; may be left out where there is one")
      .param(&Emulator::address, "address", "where it listens: an address or name of this machine")
      .param(&Emulator::port, "port",
             "of CoLa A; the host port (CoLa B) is the next one; 0: two free ones",
             velum::between(0, 65534))
      .param(&Emulator::frequency, "frequency", "of the mirror", velum::between(25.0, 100.0))
      .unit("Hz")
      .param(&Emulator::resolution, "resolution", "angle between beams; else the scene's",
             velum::above(0.0))
      .param(&Emulator::tilt_speed, "tilt_speed",
             "of the plate; else the scene's tilt_step for each whole scan", velum::above(0.0))
      .unit("deg/s")
      .param(&Emulator::encoder_counts, "encoder_counts", "of the plate's encoder, for a turn",
             velum::between(1.0, 4e9))
      .advanced()
      .param(&Emulator::encoder_zero, "encoder_zero", "its counts at tilt 0",
             velum::between(0.0, 4e9))
      .advanced()
      .param(&Emulator::noise, "noise",
             "standard deviation of a range on anything; else the scene's",
             velum::between(0.0, 1.0))
      .param(&Emulator::errors, "errors",
             "what else acts on ranges, as in devices.simulator; else the scene's")
      .param(&Emulator::serial, "serial", "serial number", velum::between(1, 99'999'999))
      .param(&Emulator::speed, "speed", "times real time; 0: as fast as the clients take it",
             velum::between(0.0, 1000.0))
      .param(&Emulator::lifetime, "lifetime", "how long it serves; 0: until interrupted",
             velum::at_least(0.0))
      .param(&Emulator::sessions, "sessions", "ends when so many clients have left; 0: never",
             velum::at_least(0))
      .choice(&Emulator::fault, "fault", "how it misbehaves, to try clients",
              {{"none", FaultKind::none, "not at all"},
               {"refuse", FaultKind::refuse, "logins are refused"},
               {"model", FaultKind::model, "another model and firmware"},
               {"error", FaultKind::error, "every request is answered with an error"},
               {"busy", FaultKind::busy, "a second client is sent away"},
               {"silence", FaultKind::silence, "nothing more is said, the connection stays open"},
               {"split", FaultKind::split, "each telegram in two parts, cut at another byte"},
               {"drip", FaultKind::drip, "a few bytes at a time"},
               {"half", FaultKind::half, "half a telegram, then the connection ends"},
               {"length", FaultKind::length, "every tenth telegram with a wrong length"},
               {"checksum", FaultKind::checksum, "every tenth telegram with a wrong byte"},
               {"garbage", FaultKind::garbage, "random bytes between telegrams"},
               {"flood", FaultKind::flood, "hundreds of events between telegrams"},
               {"gap", FaultKind::gap, "every tenth telegram is missing"},
               {"reset", FaultKind::reset, "the connection is reset"},
               {"power_cycle", FaultKind::power_cycle, "it goes off and comes back"}})
      .param(&Emulator::fault_after, "fault_after", "scans of a connection before it strikes",
             velum::at_least(0))
      .param(&Emulator::fault_code, "fault_code", "with fault = \"error\": the sFA code",
             velum::between(0, 26))
      .nondeterministic()
      .uncached()
      .reference("SICK, Telegram Listing 8014631 (LMS5xx)")
      .reference("Canciani, thesis, 2.3.1, 2.4.3");
}

// The only scanner of a scene need not be named.
std::string named(const velum::scene::Scene& seen, const std::string& name) {
  return name.empty() && seen.scanners.size() == 1 ? seen.scanners.front().name : name;
}

void Emulator::check() const {
  try {
    if (errors) static_cast<void>(velum::scene::Effects::named(*errors));
  } catch (velum::Error& error) {
    throw std::move(error).at("errors");
  }
}

velum::scene::Scene Emulator::read() const {
  velum::scene::Scene made = velum::scene::read_scene(scene.path);
  const std::string name = named(made, scanner);
  static_cast<void>(made.scanner(name));
  for (velum::scene::Scanner& one : made.scanners) {
    if (one.name != name) continue;
    if (errors) one.effects = velum::scene::Effects::named(*errors);
    if (noise) one.noise = *noise;
  }
  for (velum::scene::Object& object : made.objects)
    if (noise && object.material) object.material->noise = *noise;
  return made;
}

Mode Emulator::mode(const velum::scene::Scanner& chosen) const {
  const double degrees = resolution.value_or(velum::Angle{chosen.beam_step}) / kDegree;
  const auto found =
      velum::lms511::mode_of(static_cast<std::uint32_t>(std::lround(100.0 * frequency)),
                             static_cast<std::uint32_t>(std::lround(1e4 * degrees)));
  if (found) return *found;
  std::string known;
  for (const Mode& one : velum::lms511::kModes)
    known += fmt::format("{}{} Hz at {}", known.empty() ? "" : ", ", one.frequency / 100,
                         one.resolution / 1e4);
  throw velum::Error(
      velum::Fault::graph,
      fmt::format("an LMS 511 cannot turn at {} Hz with {} degrees", frequency, degrees))
      .hint("set `frequency` and `resolution`; it can: " + known + " degrees");
}

velum::emulator::Device Emulator::device(const Mode& mode) const {
  velum::emulator::Device device{velum::emulator::plain_profile(), mode};
  device.profile.serial = static_cast<std::uint32_t>(serial);
  device.profile.serial_text = std::to_string(serial);
  device.profile.location = "SN " + std::to_string(serial);
  device.grudge.refuse_login = fault == FaultKind::refuse;
  device.grudge.foreign_model = fault == FaultKind::model;
  if (fault == FaultKind::error)
    device.grudge.error = static_cast<velum::lms511::ErrorCode>(fault_code);
  return device;
}

// A whole scan of an interlaced mode takes several revolutions.
velum::emulator::Plate Emulator::plate(const velum::scene::Scanner& chosen,
                                       const Mode& mode) const {
  const double scans = mode.frequency / 100.0 / mode.revolutions;
  const double rate = tilt_speed ? *tilt_speed * kDegree : chosen.tilt_step * scans;
  return {{chosen.tilt_from, chosen.tilt_to, rate}, {encoder_counts, encoder_zero}};
}

velum::emulator::ServerOptions Emulator::options() const {
  return {.address = address,
          .port = static_cast<std::uint16_t>(port),
          .speed = speed,
          .lifetime = lifetime,
          .sessions = sessions,
          .fault = {fault, static_cast<std::uint64_t>(fault_after),
                    static_cast<velum::lms511::ErrorCode>(fault_code)}};
}

void Emulator::operator()(velum::Context& context) const {
  context.check();
  const velum::scene::Scene seen = read();
  // Several emulators beside each other have noise of their own, whatever the seed.
  const velum::Random random = context.random().split(static_cast<std::uint64_t>(serial + port));
  const velum::emulator::View view(seen, named(seen, scanner), random);
  const Mode turning = mode(view.scanner());
  velum::emulator::Server server(options(), device(turning), view, plate(view.scanner(), turning),
                                 context.random());
  context.info(fmt::format("listening on {}: port {} (CoLa A), port {} (host port, CoLa B)",
                           address, server.ascii_port(), server.host_port()));
  server.run(context);
  const auto& counts = server.counts();
  context.measure("connections", static_cast<double>(counts.connections), "");
  context.measure("requests", static_cast<double>(counts.requests), "");
  context.measure("scans", static_cast<double>(counts.scans), "");
  context.measure("dropped", static_cast<double>(counts.dropped), "", velum::Better::lower);
}

}  // namespace

VELUM_STAGE(Emulator)
