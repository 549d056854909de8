// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/threads.hpp"

#include <dlfcn.h>

#include <mutex>

namespace velum::run {

// The kernel does not link OpenMP, and plugins are opened privately: the run-time is looked for
// among what is loaded, and never loaded here.
void limit_openmp(int threads) {
  using Set = void (*)(int);
  static std::mutex mutex;
  static Set set = nullptr;
  const std::lock_guard lock(mutex);
  if (set == nullptr) {
    void* library = ::dlopen("libgomp.so.1", RTLD_NOLOAD | RTLD_LAZY);
    if (library == nullptr) return;
    set = reinterpret_cast<Set>(::dlsym(library, "omp_set_num_threads"));  // NOLINT
  }
  if (set != nullptr) set(threads);
}

}  // namespace velum::run
