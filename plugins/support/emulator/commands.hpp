// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string_view>

#include "emulator/device.hpp"

namespace velum::emulator {

/// One command of the device: reads the request's parameters and makes the answer. Throws Malformed
/// for what the device answers with sFA.
using Command = Answer (*)(Device& device, lms511::Reader& request, Session& session);
using Commands = std::map<std::string_view, Command>;
/// Null where the device has no such command.
[[nodiscard]] Command find_command(std::string_view kind, std::string_view name);

/// The variables that can be read, those that can be written, methods, events.
[[nodiscard]] const Commands& reads();
[[nodiscard]] const Commands& writes();
[[nodiscard]] const Commands& methods();
[[nodiscard]] const Commands& subscriptions();

/// Begins the answer to a request: "sRA" to "sRN", and so on.
[[nodiscard]] lms511::Writer begin_answer(const lms511::Reader& request);
/// The content of LIDoutputstate.
void write_outputs(lms511::Writer& answer, const Profile& profile);

}  // namespace velum::emulator
