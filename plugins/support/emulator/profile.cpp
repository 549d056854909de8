// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "emulator/profile.hpp"

#include "lms511/device.hpp"

namespace velum::emulator {
namespace {

constexpr float kScale = 2.0F;

void write(lms511::Writer& answer, const Field::Rectangle& area) {
  answer.i32(area.angle).u16(area.distance).i32(area.turned).u32(area.width).u32(area.length);
}

}  // namespace

// Scale, grid, shape; then a flag and the numbers of each kind of shape (segmented, rectangle,
// radial, dynamic); then a flag and the name, and no comment.
void Field::write(lms511::Writer& answer) const {
  answer.f32(kScale).f32(0.0F).u32(step).i32(lms511::kViewFrom).u8(shape).u8(number);
  answer.u16(corners.empty() ? 0 : 1);
  if (!corners.empty()) answer.u16(static_cast<std::uint16_t>(corners.size()));
  for (const Corner& corner : corners) answer.u16(corner.beam).u16(corner.from).u16(corner.to);
  answer.u16(rectangle ? 1 : 0);
  if (rectangle) emulator::write(answer, *rectangle);
  answer.u16(0);
  answer.u16(dynamic ? 1 : 0);
  if (dynamic) {
    emulator::write(answer, dynamic->area);
    answer.u16(dynamic->speed).u32(dynamic->stretch);
  }
  answer.u16(1).text16(name).u16(0);
}

Profile plain_profile() {
  Profile profile;
  for (std::size_t i = 0; i < 6; ++i) profile.outputs[i].state = 0;
  return profile;
}

}  // namespace velum::emulator
