// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "files/lock.hpp"

#include <sys/file.h>

#include <cerrno>

namespace velum::files {

bool lock_now(int descriptor) {
  return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

}  // namespace velum::files
