// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "velum/files.hpp"
#include "velum/stage.hpp"

namespace velum {

/// The format in which results are kept in the cache and cross from isolated stages: header, index,
/// then the columns' memory as blobs at multiples of 64 bytes, each checked by XXH3-128. Columns
/// that share memory share a blob. It is of this machine's byte order and of one version of the
/// kernel; it is no format to keep data in.
void write_flat(AtomicFile& file, const Results& results);

/// The columns of what is read view one buffer that they share, so nothing is copied. Throws Error
/// (Fault::input) when the file is damaged, cut short, not what it says it is, or of another
/// version.
Results read_flat(const std::filesystem::path& path);

}  // namespace velum
