// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

namespace velum::run {

/// Threads of OpenMP regions that the calling thread begins, where some library has loaded
/// OpenMP's run-time.
void limit_openmp(int threads);

}  // namespace velum::run
