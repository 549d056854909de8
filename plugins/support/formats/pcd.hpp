// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/assemble.hpp"
#include "velum/files.hpp"

/// Point Cloud Data, version 0.7 and earlier, of the Point Cloud Library.
namespace velum::formats {

Cloud read_pcd(Source& source, const ReadOptions& options, Context& context);

enum class PcdKind { ascii, binary, compressed };
void write_pcd(AtomicFile& file, const Cloud& cloud, PcdKind kind, double unit, Context& context);

}  // namespace velum::formats
