// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/out_fields.hpp"
#include "formats/text.hpp"

namespace velum::formats {

void write_text(AtomicFile& file, const Cloud& cloud, TextKind kind, double unit,
                Context& context) {
  OutStyle style;
  style.unit = unit;
  const OutFields fields = out_fields(cloud, style);
  const char separator = kind == TextKind::csv ? ',' : ' ';
  std::string header;
  if (kind == TextKind::xyz)
    for (const Sensor& sensor : cloud.sensors()) header += "# " + sensor_line(sensor, unit) + "\n";
  if (kind == TextKind::csv || fields.size() > 1) {
    if (kind == TextKind::xyz) header += "# ";
    for (const char* axis : {"x", "y", "z"}) (header += axis) += separator;
    for (std::size_t i = 1; i < fields.size(); ++i) (header += fields[i].name) += separator;
    header.back() = '\n';
  }
  file.write(header);
  write_lines(file, fields, cloud.size(), separator, context);
}

}  // namespace velum::formats
