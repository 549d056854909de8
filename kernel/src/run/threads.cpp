// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/threads.hpp"

#include <dlfcn.h>

#include <atomic>

namespace velum::run {

namespace {

using SetThreads = void (*)(int);
std::atomic<SetThreads> set_threads{nullptr};

}  // namespace

// The kernel does not link OpenMP, and plugins are opened privately: the run-time is looked for
// among what is loaded, and never loaded here.
void find_openmp() {
  if (set_threads != nullptr) return;
  void* library = ::dlopen("libgomp.so.1", RTLD_NOLOAD | RTLD_LAZY);
  if (library == nullptr) return;
  set_threads = reinterpret_cast<SetThreads>(::dlsym(library, "omp_set_num_threads"));  // NOLINT
}

void limit_openmp(int threads) {
  if (const SetThreads set = set_threads) set(threads);
}

}  // namespace velum::run
