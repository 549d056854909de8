// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <array>

#include "emulator/calendar.hpp"
#include "emulator/commands.hpp"

namespace velum::emulator {
namespace {

using lms511::ErrorCode;
using lms511::Reader;
using lms511::Writer;

// An answer of one text, number or both, out of the profile.
template <std::string Profile::*Text>
Answer text(Device& device, Reader& request, Session& /*session*/) {
  return {begin_answer(request).text16(device.profile.*Text).frame()};
}
template <std::uint32_t Profile::*Number>
Answer number(Device& device, Reader& request, Session& /*session*/) {
  return {begin_answer(request).u32(device.profile.*Number).frame()};
}

Answer ident(Device& device, Reader& request, Session& /*session*/) {
  const bool foreign = device.grudge.foreign_model;
  return {begin_answer(request)
              .text16(foreign ? "TiM361" : device.profile.ident)
              .text16(foreign ? "V2.50-10.10.2016" : device.profile.ident_version)
              .frame()};
}

Answer firmware(Device& device, Reader& request, Session& /*session*/) {
  return {begin_answer(request)
              .text16(device.grudge.foreign_model ? "V2.50" : device.profile.firmware)
              .frame()};
}

// "Ready" is 1, but real devices say 0 to a client that has just logged in.
Answer device_state(Device& /*device*/, Reader& request, Session& session) {
  return {begin_answer(request).u8(session.level > 0 ? 0 : 1).frame()};
}

Answer output_range(Device& device, Reader& request, Session& /*session*/) {
  return {begin_answer(request)
              .u16(1)
              .u32(device.mode.resolution)
              .i32(device.range_from)
              .i32(device.range_to)
              .frame()};
}

Answer scan_config(Device& device, Reader& request, Session& /*session*/) {
  const lms511::Mode& mode = device.next_mode.value_or(device.mode);
  return {begin_answer(request)
              .u32(mode.frequency)
              .u16(1)
              .u32(mode.resolution)
              .i32(lms511::kViewFrom)
              .i32(lms511::kViewTo)
              .frame()};
}

Answer inputs(Device& device, Reader& request, Session& /*session*/) {
  Writer answer = begin_answer(request);
  answer.u16(0).u32(device.profile.inputs_changed).u8(0).u8(0).u8(0).u8(0).u16(1);
  write_moment(answer, device.profile.inputs_changed_at);
  return {answer.frame()};
}

Answer outputs(Device& device, Reader& request, Session& /*session*/) {
  Writer answer = begin_answer(request);
  write_outputs(answer, device.profile);
  return {answer.frame()};
}

Answer clean(Device& /*device*/, Reader& request, Session& /*session*/) {
  return {begin_answer(request).u8(0).frame()};
}

// Time and date are texts in CoLa A, and numbers with signs between in CoLa B.
Answer status(Device& device, Reader& request, Session& /*session*/) {
  const lms511::Moment now = device.moment();
  const auto state = static_cast<std::uint16_t>(device.measuring ? lms511::DeviceState::measuring
                                                                 : lms511::DeviceState::ready);
  Writer answer = begin_answer(request);
  answer.u16(state).u8(0);
  if (request.dialect() == lms511::Dialect::ascii) {
    answer.text16(fmt::format("{:02}:{:02}:{:02}", now.hour, now.minute, now.second));
    answer.text16(fmt::format("{:02}.{:02}.{:04}", now.day, now.month, now.year));
    return {answer.u16(0).u16(0).u16(0).frame()};
  }
  answer.u16(8).u16(now.hour).characters(":").u16(now.minute).characters(":").u16(now.second);
  answer.u16(10).u16(now.day).characters(".").u16(now.month).characters(".").u32(now.year);
  for (int led_or_reserved = 0; led_or_reserved < 6; ++led_or_reserved) answer.u16(0);
  return {answer.frame()};
}

// No other device to be synchronised with: state 1, 0 Hz.
Answer synchronisation(Device& /*device*/, Reader& request, Session& /*session*/) {
  return {begin_answer(request).u8(1).f32(0.0F).frame()};
}

Answer last_scan(Device& /*device*/, Reader& /*request*/, Session& /*session*/) {
  return {{}, Effect::scan};
}

// The ten fields, then twenty that a device of this firmware has and leaves empty.
Answer field(Device& device, Reader& request, Session& /*session*/) {
  const std::string_view name = request.name();
  const auto number =
      static_cast<std::size_t>(100 * (name[5] - '0') + 10 * (name[6] - '0') + (name[7] - '0'));
  Writer answer = begin_answer(request);
  if (number < device.profile.fields.size())
    device.profile.fields[number].write(answer);
  else
    answer.u8(0);
  return {answer.frame()};
}

Answer plain(Device& device, Reader& request, Session& /*session*/) {
  Writer answer = begin_answer(request);
  device.variables.read(request.name(), answer);
  return {answer.frame()};
}

Commands make_reads() {
  Commands commands{{"DeviceIdent", ident},
                    {"FirmwareVersion", firmware},
                    {"LocationName", text<&Profile::location>},
                    {"DItype", text<&Profile::type>},
                    {"DIornr", text<&Profile::order_number>},
                    {"SerialNumber", text<&Profile::serial_text>},
                    {"ODoprh", number<&Profile::operating_time>},
                    {"ODpwrc", number<&Profile::power_ups>},
                    {"SCdevicestate", device_state},
                    {"LCMstate", clean},
                    {"STlms", status},
                    {"LMPoutputRange", output_range},
                    {"LMPscancfg", scan_config},
                    {"LIDinputstate", inputs},
                    {"LIDoutputstate", outputs},
                    {"SYextmon", synchronisation},
                    {"LMDscandata", last_scan}};
  static const auto fields = [] {
    std::array<std::string, 30> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = fmt::format("field{:03}", i);
    return names;
  }();
  for (const std::string& name : fields) commands[name] = field;
  for (const std::string_view name : plain_variables()) commands[name] = plain;
  return commands;
}

}  // namespace

void write_outputs(Writer& answer, const Profile& profile) {
  answer.u16(0).u32(profile.outputs_changed);
  for (const Output& output : profile.outputs) answer.u8(output.state).u32(output.changes);
  answer.u16(1);
  write_moment(answer, profile.outputs_changed_at);
}

const Commands& reads() {
  static const Commands commands = make_reads();
  return commands;
}

}  // namespace velum::emulator
