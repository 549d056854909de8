// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "emulator/commands.hpp"

namespace velum::emulator {
namespace {

using lms511::ErrorCode;
using lms511::Reader;

constexpr std::uint8_t kClientLevel = 3;

void need_level(const Reader& request, const Session& session) {
  if (session.level < kClientLevel)
    request.fail(ErrorCode::write_denied, "the client is not logged in");
}

Answer done(const Reader& request) {
  return {begin_answer(request).no_parameters().frame()};
}

Answer write_plain(Device& device, Reader& request, Session& session) {
  need_level(request, session);
  device.variables.write(request);
  return done(request);
}

// The resolution is not taken from here, only the angles.
Answer write_range(Device& device, Reader& request, Session& session) {
  need_level(request, session);
  static_cast<void>(request.u16());
  static_cast<void>(request.u32());
  const std::int32_t from = request.i32();
  const std::int32_t to = request.i32();
  if (from < lms511::kViewFrom || to > lms511::kViewTo || from > to)
    request.fail(ErrorCode::out_of_range, "an angle out of -5 to 185 degrees");
  device.range_from = from;
  device.range_to = to;
  return done(request);
}

Answer write_dialect(Device& device, Reader& request, Session& session) {
  need_level(request, session);
  const std::uint8_t dialect = request.u8();
  if (dialect > 1) request.fail(ErrorCode::out_of_range, "no dialect of CoLa");
  device.host_dialect = dialect == 0 ? lms511::Dialect::ascii : lms511::Dialect::binary;
  return done(request);
}

Answer write_location(Device& device, Reader& request, Session& session) {
  need_level(request, session);
  device.profile.location = std::string(request.text16());
  return done(request);
}

Answer write_denied(Device& /*device*/, Reader& request, Session& /*session*/) {
  request.fail(ErrorCode::write_denied, "a variable that is only read");
}

Commands make_writes() {
  Commands commands;
  for (const auto& [name, read] : reads()) commands[name] = write_denied;
  for (const std::string_view name : plain_variables()) commands[name] = write_plain;
  commands["LMPoutputRange"] = write_range;
  commands["EIHstCola"] = write_dialect;
  commands["LocationName"] = write_location;
  return commands;
}

template <bool Session::*Event, Effect When = Effect::none>
Answer subscribe(Device& /*device*/, Reader& request, Session& session) {
  const std::uint8_t on = request.u8();
  if (on > 1) request.fail(ErrorCode::out_of_range, "neither on nor off");
  session.*Event = on == 1;
  return {begin_answer(request).u8(on).frame(), on == 1 ? When : Effect::none};
}

}  // namespace

const Commands& writes() {
  static const Commands commands = make_writes();
  return commands;
}

const Commands& subscriptions() {
  static const Commands commands{
      {"LMDscandata", subscribe<&Session::scans, Effect::scans_on>},
      {"LIDoutputstate", subscribe<&Session::outputs, Effect::outputs_on>},
      {"LIDinputstate", subscribe<&Session::inputs>},
      {"LFErec", subscribe<&Session::fields>}};
  return commands;
}

}  // namespace velum::emulator
