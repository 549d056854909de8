// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lms511/lines.hpp"

namespace velum::lms511 {

/// The first line of a message that is a picture of what a recorder sees, not a remark. The command
/// draws it in place.
inline constexpr std::string_view kViewMark = "[live view]";

/// Draws what comes from a scanner as text: rates, a histogram of ranges, and the last line seen
/// from the side (thesis 2.3: the plane of the beams, x to the right, y up).
class LiveView {
 public:
  /// Looks at a line before it is forgotten.
  void see(const Line& line);
  /// The picture: kViewMark, then lines of at most 72 characters. `seconds` since the start,
  /// `share` of the sweep that is done (0 to 1), `bytes` in the file.
  [[nodiscard]] std::string draw(const LineCounts& counts, double seconds, double share,
                                 std::uint64_t bytes);

 private:
  Line last_;
  std::uint64_t lines_before_ = 0;
  double seconds_before_ = 0.0;
};

}  // namespace velum::lms511
