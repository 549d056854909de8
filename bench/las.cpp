// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstring>
#include <fstream>

#include "clouds.hpp"

namespace bench {
namespace {

constexpr std::size_t kHeader = 227;
constexpr std::size_t kRecord = 20;
constexpr double kStep = 1e-4;  // [m]

/// Little-endian fields at fixed places, as on the machines that we run on.
template <class T>
void put(std::vector<char>& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

std::vector<char> header_of(const velum::Cloud& cloud) {
  std::vector<char> bytes(kHeader, 0);
  std::memcpy(bytes.data(), "LASF", 4);
  put<std::uint8_t>(bytes, 24, 1);  // version 1.2
  put<std::uint8_t>(bytes, 25, 2);
  put<std::uint16_t>(bytes, 94, kHeader);
  put<std::uint32_t>(bytes, 96, kHeader);  // where the points begin
  put<std::uint16_t>(bytes, 105, kRecord);
  put<std::uint32_t>(bytes, 107, static_cast<std::uint32_t>(cloud.size()));
  const Eigen::AlignedBox3f box = velum::bounding_box(cloud.positions());
  for (int axis = 0; axis < 3; ++axis) {
    const auto slot = static_cast<std::size_t>(axis);
    put(bytes, 131 + 8 * slot, kStep);
    put(bytes, 179 + 16 * slot, static_cast<double>(box.max()[axis]));
    put(bytes, 187 + 16 * slot, static_cast<double>(box.min()[axis]));
  }
  return bytes;
}

}  // namespace

void write_las(const std::string& file, const velum::Cloud& cloud) {
  std::vector<char> bytes = header_of(cloud);
  bytes.resize(kHeader + kRecord * static_cast<std::size_t>(cloud.size()), 0);
  std::size_t at = kHeader;
  for (velum::Index i = 0; i < cloud.size(); ++i, at += kRecord)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto value = static_cast<double>(cloud.positions()(static_cast<int>(axis), i));
      put(bytes, at + 4 * axis, static_cast<std::int32_t>(std::lround(value / kStep)));
    }
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out) throw std::runtime_error("cannot write " + file);
}

}  // namespace bench
