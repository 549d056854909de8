// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/records.hpp"
#include "formats/source.hpp"
#include "velum/context.hpp"

namespace velum::formats {

/// How to read a file.
struct ReadOptions {
  double unit = 1.0;  ///< of the file's lengths [m]
  /// The file's axes are left-handed with y up (3DTK): its z, -x, y become x, y, z.
  bool left_handed = false;
  /// Names of the columns of a text file, in order; empty: by its header or number of columns.
  std::vector<std::string> columns;
};

/// What to do with records that have no finite position.
enum class NotFinite {
  drop,   ///< leave them out, say and measure how many
  refuse  ///< throw: in a mesh others count on their number
};

/// A cloud of the records' fields x, y, z and all others as its columns.
Cloud assemble(const Source& source, const Records& records, const ReadOptions& options,
               NotFinite not_finite, Context& context);

/// A sensor's line in a file's comments, "velum sensor TX TY TZ QW QX QY QZ NAME".
std::string sensor_line(const Sensor& sensor, double unit);
/// Adds the sensor that a comment tells of, if it does.
void read_sensor_line(std::string_view comment, std::vector<Sensor>& sensors);
/// A pose from translation and quaternion (w, x, y, z); nothing when they are not finite or the
/// quaternion is zero.
std::optional<Pose> pose_of(const std::array<double, 7>& values);

}  // namespace velum::formats
