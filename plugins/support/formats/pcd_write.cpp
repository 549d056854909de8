// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <limits>

#include "formats/lzf.hpp"
#include "formats/out_fields.hpp"
#include "formats/pcd.hpp"
#include "formats/rows.hpp"

namespace velum::formats {
namespace {

std::string header_of(const Cloud& cloud, const OutFields& fields, PcdKind kind, double unit) {
  std::string names;
  std::string sizes;
  std::string types;
  std::string counts;
  const auto add = [&](std::string_view name, FieldType type, Index width) {
    const char letter = is_real(type) ? 'F' : name_of(type).front() == 'u' ? 'U' : 'I';
    names += fmt::format(" {}", name);
    sizes += fmt::format(" {}", size_of(type));
    types += fmt::format(" {}", letter);
    counts += fmt::format(" {}", width);
  };
  for (const char* axis : {"x", "y", "z"}) add(axis, fields.front().type, 1);
  for (std::size_t i = 1; i < fields.size(); ++i)
    add(fields[i].name, fields[i].type, fields[i].width);

  std::string header = "# .PCD v0.7 - Point Cloud Data file format\n";
  if (cloud.sensors().size() > 1 ||
      (cloud.sensors().size() == 1 && !cloud.sensors()[0].name.empty()))
    for (const Sensor& sensor : cloud.sensors()) header += "# " + sensor_line(sensor, unit) + "\n";
  header += fmt::format("VERSION 0.7\nFIELDS{}\nSIZE{}\nTYPE{}\nCOUNT{}\nWIDTH {}\nHEIGHT 1\n",
                        names, sizes, types, counts, cloud.size());
  if (!cloud.sensors().empty()) {
    const Pose& pose = cloud.sensors().front().pose;
    const Eigen::Quaterniond turn(pose.linear());
    const Eigen::Vector3d place = pose.translation() / unit;
    header += fmt::format("VIEWPOINT {} {} {} {} {} {} {}\n", place.x(), place.y(), place.z(),
                          turn.w(), turn.x(), turn.y(), turn.z());
  }
  constexpr std::string_view kKinds[] = {"ascii", "binary", "binary_compressed"};
  return header +
         fmt::format("POINTS {}\nDATA {}\n", cloud.size(), kKinds[static_cast<std::size_t>(kind)]);
}

/// Field after field, and positions axis after axis.
Buffer planes_of(const OutFields& fields, Index count) {
  Buffer planes(stride_of(fields) * static_cast<std::size_t>(count));
  std::byte* to = planes.data.get();
  const OutField& positions = fields.front();
  const Buffer places(positions.bytes() * static_cast<std::size_t>(count));
  positions.fill(0, count, places.data.get(), positions.bytes());
  const std::size_t size = size_of(positions.type);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (Index i = 0; i < count; ++i, to += size)
      std::memcpy(to, places.data.get() + static_cast<std::size_t>(i) * 3 * size + axis * size,
                  size);
  for (std::size_t f = 1; f < fields.size(); ++f) {
    fields[f].fill(0, count, to, fields[f].bytes());
    to += fields[f].bytes() * static_cast<std::size_t>(count);
  }
  return planes;
}

void write_compressed(AtomicFile& file, const OutFields& fields, Index count, Context& context) {
  const Buffer planes = planes_of(fields, count);
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (planes.size > kMost / 33 * 32)
    throw Error(Fault::output, fmt::format("{} bytes of points are too many for a compressed PCD, "
                                           "which holds 4 GB",
                                           planes.size))
        .hint("write format = \"pcd\" (binary)");
  context.check();
  const std::vector<std::byte> packed = lzf_pack({planes.data.get(), planes.size});
  const std::uint32_t sizes[] = {static_cast<std::uint32_t>(packed.size()),
                                 static_cast<std::uint32_t>(planes.size)};
  file.write(std::as_bytes(std::span(sizes)));
  file.write(packed);
}

}  // namespace

void write_pcd(AtomicFile& file, const Cloud& cloud, PcdKind kind, double unit, Context& context) {
  OutStyle style;
  style.pcd = true;
  style.unit = unit;
  const OutFields fields = out_fields(cloud, style);
  file.write(header_of(cloud, fields, kind, unit));
  switch (kind) {
    case PcdKind::ascii:
      return write_lines(file, fields, cloud.size(), ' ', context);
    case PcdKind::binary:
      return write_rows(file, fields, cloud.size(), false, context);
    case PcdKind::compressed:
      return write_compressed(file, fields, cloud.size(), context);
  }
}

}  // namespace velum::formats
