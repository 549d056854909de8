// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "emulator/commands.hpp"

namespace velum::emulator {

Command find_command(std::string_view kind, std::string_view name) {
  static const std::map<std::string_view, const Commands&> kinds{
      {"sRN", reads()}, {"sWN", writes()}, {"sMN", methods()}, {"sEN", subscriptions()}};
  const auto known = kinds.find(kind);
  if (known == kinds.end()) return nullptr;
  const auto found = known->second.find(name);
  return found == known->second.end() ? nullptr : found->second;
}

lms511::Writer begin_answer(const lms511::Reader& request) {
  static const std::map<std::string_view, std::string_view> answers{
      {"sRN", "sRA"}, {"sWN", "sWA"}, {"sMN", "sAN"}, {"sEN", "sEA"}};
  return {request.dialect(), answers.at(request.kind()), request.name()};
}

}  // namespace velum::emulator
