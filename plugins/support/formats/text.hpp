// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/assemble.hpp"
#include "velum/files.hpp"

/// Plain text, one point a line: XYZ, TXT, CSV, tab-separated, PTS, and the thesis's x y z.
namespace velum::formats {

Cloud read_text(Source& source, const ReadOptions& options, Context& context);

/// How a text file names its columns.
enum class TextKind {
  xyz,  ///< blanks between values; a comment names the columns unless they are x y z alone
  csv,  ///< commas, names in the first line
};
void write_text(AtomicFile& file, const Cloud& cloud, TextKind kind, double unit, Context& context);

}  // namespace velum::formats
