// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "emulator/variables.hpp"

#include <bit>

namespace velum::emulator {
namespace {

std::uint32_t read_number(lms511::Reader& request, char type) {
  switch (type) {
    case '1':
      return request.u8();
    case '2':
      return request.u16();
    case 'f':
      return std::bit_cast<std::uint32_t>(request.f32());
    default:
      return request.u32();
  }
}

void write_number(lms511::Writer& answer, char type, std::uint32_t value) {
  switch (type) {
    case '1':
      answer.u8(static_cast<std::uint8_t>(value));
      break;
    case '2':
      answer.u16(static_cast<std::uint16_t>(value));
      break;
    case 'f':
      answer.f32(std::bit_cast<float>(value));
      break;
    default:
      answer.u32(value);
  }
}

}  // namespace

Variables::Variables()
    : all_{{"LMDscandatacfg", {"111111111112", {0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1}}},
           {"FREchoFilter", {"1", {2}, 2}},
           {"LFPparticle", {"12", {0, 500}, 1}},
           {"LFPmeanfilter", {"121", {0, 2, 0}, 1}},
           {"CLFogFilterEn", {"1", {0}, 1}},
           {"MCSenseLevel", {"1", {5}, 6}},
           {"LMPautostartmeas", {"1", {1}, 1}},
           {"DO3And4Fnc", {"1", {0}, 2}},
           {"DO6Fnc", {"1", {0}, 8}},
           {"LICsrc", {"1", {0}, 1}},
           {"LICencset", {"1", {0}, 3}},
           {"LICencres", {"f", {0x3F800000}}},
           {"SYMode", {"1", {0}, 3}},
           {"SYPhase", {"2", {0}}},
           {"TSCRole", {"1", {0}, 3}},
           {"TSCTCInterface", {"1", {0}, 3}},
           {"TSCTCSrvAddr", {"1111", {192, 168, 0, 2}}},
           {"TSCTCtimezone", {"1", {0}, 24}},
           {"TSCTCupdatetime", {"4", {600}}}} {}

void Variables::write(lms511::Reader& request) {
  Variable& variable = all_.find(request.name())->second;
  std::vector<std::uint32_t> values;
  for (const char type : variable.types) values.push_back(read_number(request, type));
  if (!request.at_end()) request.fail(lms511::ErrorCode::too_many_bytes, "more than it takes");
  if (values.front() > variable.most)
    request.fail(lms511::ErrorCode::out_of_range, "a value that it cannot have");
  variable.values = std::move(values);
}

void Variables::read(std::string_view name, lms511::Writer& answer) const {
  const Variable& variable = all_.find(name)->second;
  for (std::size_t i = 0; i < variable.types.size(); ++i)
    write_number(answer, variable.types[i], variable.values[i]);
}

std::uint32_t Variables::value(std::string_view name, std::size_t index) const {
  return all_.find(name)->second.values.at(index);
}

std::vector<std::string_view> plain_variables() {
  static const Variables variables;
  std::vector<std::string_view> names;
  for (const auto& [name, variable] : variables.all()) names.push_back(name);
  return names;
}

}  // namespace velum::emulator
