// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "emulator/calendar.hpp"
#include "emulator/commands.hpp"

namespace velum::emulator {
namespace {

using lms511::ErrorCode;
using lms511::Reader;

constexpr std::uint8_t kClientLevel = 3;

void need_level(const Reader& request, const Session& session) {
  if (session.level < kClientLevel)
    request.fail(ErrorCode::access_denied, "the client is not logged in");
}

Answer login(Device& device, Reader& request, Session& session) {
  constexpr std::array kLevels{lms511::kMaintenance, lms511::kAuthorisedClient, lms511::kService};
  const std::uint8_t level = request.u8();
  const std::uint32_t hash = request.u32();
  const bool right = std::any_of(kLevels.begin(), kLevels.end(), [&](const lms511::Access& one) {
    return one.level == level && one.hash == hash;
  });
  const bool accepted = right && !device.grudge.refuse_login;
  if (accepted) session.level = level;
  return {begin_answer(request).u8(accepted ? 1 : 0).frame()};
}

Answer run(Device& device, Reader& request, Session& session) {
  session.level = 0;
  const bool changed = device.next_mode && device.next_mode->frequency != device.mode.frequency;
  if (device.next_mode) device.mode = *device.next_mode;
  device.next_mode.reset();
  return {begin_answer(request).u8(1).frame(), changed ? Effect::speed : Effect::none};
}

// Why a pair cannot be had: 1 for its frequency, 2 for its resolution, 3 for both.
std::uint8_t refusal(std::uint32_t frequency, std::uint32_t resolution) {
  const auto any = [](auto member, std::uint32_t value) {
    return std::any_of(lms511::kModes.begin(), lms511::kModes.end(),
                       [&](const lms511::Mode& mode) { return mode.*member == value; });
  };
  const bool frequency_known = any(&lms511::Mode::frequency, frequency);
  const bool resolution_known = any(&lms511::Mode::resolution, resolution);
  if (frequency_known) return 2;
  return resolution_known ? 1 : 3;
}

// Start and stop have no effect on an LMS 511: only LMPoutputRange cuts.
Answer set_scan(Device& device, Reader& request, Session& session) {
  need_level(request, session);
  const std::uint32_t frequency = request.u32();
  const std::uint16_t sectors = request.u16();
  const std::uint32_t resolution = request.u32();
  const std::int32_t from = request.i32();
  const std::int32_t to = request.i32();
  const auto mode = lms511::mode_of(frequency, resolution);
  std::uint8_t status = 0;
  if (!mode)
    status = refusal(frequency, resolution);
  else if (from < lms511::kViewFrom || to > lms511::kViewTo || from > to)
    status = 4;
  else if (sectors != 1)
    status = 5;
  if (status == 0) device.next_mode = mode;
  return {begin_answer(request)
              .u8(status)
              .u32(frequency)
              .u16(sectors)
              .u32(resolution)
              .i32(from)
              .i32(to)
              .frame()};
}

// The numbers of the modes: 0 to 9, then the interlaced A to F and 10 (hexadecimal).
Answer set_listed(Device& device, Reader& request, Session& session) {
  need_level(request, session);
  const std::uint8_t number = request.u8();
  const bool known = number < lms511::kModes.size();
  if (known) device.next_mode = lms511::kModes[number];
  return {begin_answer(request).u8(known ? 0 : 1).frame()};
}

Answer start(Device& device, Reader& request, Session& session) {
  if (session.level < kClientLevel) return {begin_answer(request).u8(1).frame()};
  device.measuring = true;
  device.switched_on = true;
  return {begin_answer(request).u8(0).frame()};
}

Answer stop(Device& device, Reader& request, Session& session) {
  if (session.level < kClientLevel) return {begin_answer(request).u8(1).frame()};
  device.measuring = false;
  return {begin_answer(request).u8(0).frame()};
}

Answer set_date(Device& device, Reader& request, Session& session) {
  need_level(request, session);
  lms511::Moment moment;
  moment.year = request.u16();
  moment.month = request.u8();
  moment.day = request.u8();
  moment.hour = request.u8();
  moment.minute = request.u8();
  moment.second = request.u8();
  moment.microsecond = request.u32();
  if (moment.month < 1 || moment.month > 12 || moment.day < 1 || moment.day > 31 ||
      moment.hour > 23 || moment.minute > 59 || moment.second > 59)
    request.fail(ErrorCode::out_of_range, "no date and time");
  device.calendar = seconds_of(moment) - 1e-6 * device.clock;
  return {begin_answer(request).u8(1).frame()};
}

Answer set_output(Device& device, Reader& request, Session& session) {
  need_level(request, session);
  const std::uint8_t number = request.u8();
  const std::uint8_t state = request.u8();
  if (number < 1 || number > 6 || state > 1)
    request.fail(ErrorCode::out_of_range, "outputs are 1 to 6, on or off");
  Output& output = device.profile.outputs[number - 1U];
  if (output.state != state) ++output.changes;
  output.state = state;
  device.profile.outputs_changed =
      static_cast<std::uint32_t>(static_cast<std::uint64_t>(device.clock));
  device.profile.outputs_changed_at = device.moment();
  return {begin_answer(request).u8(1).frame(), Effect::outputs_on};
}

// Settings stay in memory, so storing them is done.
Answer store(Device& /*device*/, Reader& request, Session& session) {
  need_level(request, session);
  return {begin_answer(request).u8(1).frame()};
}

Answer factory_settings(Device& device, Reader& request, Session& session) {
  need_level(request, session);
  device.variables = Variables();
  device.range_from = lms511::kViewFrom;
  device.range_to = lms511::kViewTo;
  return {begin_answer(request).u8(1).frame()};
}

Answer reboot(Device& /*device*/, Reader& request, Session& session) {
  need_level(request, session);
  return {begin_answer(request).no_parameters().frame(), Effect::reboot};
}

}  // namespace

const Commands& methods() {
  static const Commands commands{{"SetAccessMode", login},
                                 {"Run", run},
                                 {"mLMPsetscancfg", set_scan},
                                 {"mCLsetscancfglist", set_listed},
                                 {"LMCstartmeas", start},
                                 {"LMCstopmeas", stop},
                                 {"LMCstandby", stop},
                                 {"LSPsetdatetime", set_date},
                                 {"mDOSetOutput", set_output},
                                 {"mEEwriteall", store},
                                 {"mSCloadfacdef", factory_settings},
                                 {"mSCreboot", reboot}};
  return commands;
}

}  // namespace velum::emulator
