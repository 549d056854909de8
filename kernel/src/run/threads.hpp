// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

namespace velum::run {

/// Looks whether some library has loaded OpenMP's run-time; to be called when all plugins are open.
void find_openmp();
/// Threads of OpenMP regions that the calling thread begins, where OpenMP was found.
void limit_openmp(int threads);

}  // namespace velum::run
