// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "emulator/device.hpp"

#include "emulator/calendar.hpp"
#include "emulator/commands.hpp"

namespace velum::emulator {

using lms511::ErrorCode;

namespace {

// What an unknown name is called depends on the kind of request.
ErrorCode unknown(std::string_view kind) {
  if (kind == "sRN" || kind == "sWN") return ErrorCode::variable_unknown;
  if (kind == "sMN") return ErrorCode::method_unknown;
  if (kind == "sEN") return ErrorCode::event_unknown;
  return ErrorCode::kind_unknown;
}

}  // namespace

Answer answer(Device& device, const lms511::Telegram& telegram, Session& session) {
  const auto refusal = [&](ErrorCode code) -> Answer {
    return {lms511::error_frame(telegram.dialect, code)};
  };
  if (device.grudge.error) return refusal(*device.grudge.error);
  try {
    lms511::Reader request(telegram);
    const Command command = find_command(request.kind(), request.name());
    if (command == nullptr) return refusal(unknown(request.kind()));
    return command(device, request, session);
  } catch (const lms511::Malformed& fault) {
    return refusal(fault.code());
  }
}

lms511::Moment Device::moment() const {
  return moment_of(calendar + 1e-6 * clock);
}

std::string outputs_event(const Device& device, lms511::Dialect dialect) {
  lms511::Writer event(dialect, "sSN", "LIDoutputstate");
  write_outputs(event, device.profile);
  return event.frame();
}

}  // namespace velum::emulator
