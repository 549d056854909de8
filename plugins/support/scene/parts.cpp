// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/parts.hpp"

#include <numbers>

#include "graph/diagnostic.hpp"

namespace velum::scene {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

template <class T>
std::vector<std::string> names_of(const std::map<std::string, T, std::less<>>& all) {
  std::vector<std::string> names;
  for (const auto& [name, one] : all) names.push_back(name);
  return names;
}

Material named_by(Keys& keys, std::string_view key, const Materials& materials) {
  const std::string name = keys.text(key);
  const auto own = materials.find(name);
  if (own != materials.end()) return own->second;
  if (const auto known = known_material(name)) return *known;
  auto names = names_of(materials);
  for (auto& one : known_materials()) names.push_back(std::move(one));
  keys.fail(key, "is \"" + name + "\", which is no material", graph::known_list(names));
}

Effects effects_of(Keys& keys) {
  try {
    return Effects::named(keys.text("errors"));
  } catch (const Error& error) {
    if (error.fault() != Fault::graph) throw;
    keys.fail("errors", std::string("is wrong: ") + error.what(), error.hint());
  }
}

void check(const Scanner& scanner, Keys& keys) {
  for (const char* key : {"beam_step", "tilt_step"})
    if (keys.angle(key, 1.0) < 0.01 * kDegree) keys.fail(key, "must be at least 0.01 degrees");
  if (scanner.beam_to < scanner.beam_from) keys.fail("beam_to", "must not lie before beam_from");
  if (scanner.tilt_to < scanner.tilt_from) keys.fail("tilt_to", "must not lie before tilt_from");
  if (scanner.beam_to - scanner.beam_from > 360.5 * kDegree)
    keys.fail("beam_to", "must lie within a full turn of beam_from");
  if (scanner.tilt_to - scanner.tilt_from > 360.5 * kDegree)
    keys.fail("tilt_to", "must lie within a full turn of tilt_from");
  if (scanner.noise < 0.0) keys.fail("noise", "must not be negative");
  if (scanner.repeats < 1) keys.fail("repeats", "must be at least 1");
  if (scanner.period < 0.0) keys.fail("period", "must not be negative");
  if (scanner.range_min < 0.0 || scanner.range_max <= scanner.range_min)
    keys.fail("range_max", "must lie above range_min, which must not be negative");
}

}  // namespace

Pose frame_of(Keys& keys, const Frames& frames) {
  if (!keys.has("frame")) return Pose::Identity();
  const std::string name = keys.text("frame");
  const auto found = frames.find(name);
  if (found != frames.end()) return found->second;
  keys.fail("frame", "is \"" + name + "\", which the file does not define",
            graph::known_list(names_of(frames)));
}

Material material_of(Keys& keys, const Materials& materials) {
  return named_by(keys, "material", materials);
}

Material read_material(const SceneFile& file, const Entry& entry, const Materials& materials) {
  Keys keys(file, entry.value, "material '" + entry.key + "'");
  Material material;
  if (keys.has("like")) material = named_by(keys, "like", materials);
  material.noise = keys.length("noise", material.noise);
  material.offset = keys.length("offset", material.offset);
  material.remission = keys.number("remission", material.remission);
  material.transmission = keys.number("transmission", material.transmission);
  if (material.noise < 0.0) keys.fail("noise", "must not be negative");
  if (material.remission <= 0.0) keys.fail("remission", "must be above 0");
  if (material.transmission < 0.0 || material.transmission >= 1.0)
    keys.fail("transmission", "must be at least 0 and below 1");
  keys.finish();
  return material;
}

Sun read_sun(const SceneFile& file, const Node& table) {
  Keys keys(file, table, "the sun");
  Sun sun;
  static_cast<void>(keys.node("direction"));
  sun.direction = keys.direction("direction", sun.direction);
  sun.width = keys.angle("width", sun.width);
  if (sun.width <= 0.0) keys.fail("width", "must be above 0");
  keys.finish();
  return sun;
}

Scanner read_scanner(const SceneFile& file, const Entry& entry, const Frames& frames) {
  Keys keys(file, entry.value, "scanner '" + entry.key + "'");
  Scanner scanner;
  scanner.name = entry.key;
  const Pose frame = frame_of(keys, frames);
  scanner.pose = frame * keys.pose();
  scanner.beam_from = keys.angle("beam_from", scanner.beam_from);
  scanner.beam_to = keys.angle("beam_to", scanner.beam_to);
  scanner.beam_step = keys.angle("beam_step", scanner.beam_step);
  scanner.tilt_from = keys.angle("tilt_from", scanner.tilt_from);
  scanner.tilt_to = keys.angle("tilt_to", scanner.tilt_to);
  scanner.tilt_step = keys.angle("tilt_step", scanner.tilt_step);
  scanner.noise = keys.length("noise", scanner.noise);
  if (keys.has("errors")) scanner.effects = effects_of(keys);
  if (keys.has("repeats")) scanner.repeats = keys.integer("repeats");
  scanner.period = keys.number("period", scanner.period);
  scanner.range_min = keys.length("range_min", scanner.range_min);
  scanner.range_max = keys.length("range_max", scanner.range_max);
  check(scanner, keys);
  keys.finish();
  return scanner;
}

}  // namespace velum::scene
