// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

namespace velum::files {

/// Takes the lock of an open file (flock), held until it is closed; false when another process has
/// it. Where the file system has no locks it is taken: what it guards must be right without it,
/// also where locks do not hold between hosts.
[[nodiscard]] bool lock_now(int descriptor);

}  // namespace velum::files
