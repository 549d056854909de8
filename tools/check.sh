#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# The long check: format and clang. The steps tidy, asan, tsan, long and fuzz are run by name,
# `tools/check.sh asan`, until each has been seen to pass on a fresh machine.
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=$(nproc)
fuzz_seconds=${FUZZ_SECONDS:-60}

step_format() { tools/format.sh --check; }

step_clang() {  # the kernel and its tests with clang's warnings
  cmake --preset clang >/dev/null
  cmake --build --preset clang
}

step_tidy() {  # the kernel, and what differs from the last commit elsewhere
  cmake --preset clang >/dev/null
  git ls-files 'kernel/src/*.cpp' 'kernel/app/*.cpp' |
    xargs -P "$jobs" -n 4 clang-tidy-14 -p build/clang --quiet
}

step_asan() {  # address and undefined behaviour, all plugins
  cmake --preset asan >/dev/null
  cmake --build --preset asan
  ctest --preset asan -LE "long|sdk"
}

step_tsan() {  # the kernel's threads, with a oneTBB that is itself instrumented
  tools/tsan_tbb.sh build/tsan-tbb
  cmake --preset tsan -DTBB_DIR="$PWD/build/tsan-tbb/lib/cmake/TBB" >/dev/null
  cmake --build --preset tsan
  ctest --preset tsan -LE long
}

step_long() { ctest --preset release -L long; }

step_fuzz() {
  cmake --preset fuzz >/dev/null
  cmake --build --preset fuzz
  local target
  for target in build/fuzz/fuzz/*; do
    [ -x "$target" ] && [ -f "$target" ] && echo "$target"
  done | xargs -P "$jobs" -I{} tools/fuzz.sh {} "$fuzz_seconds"
}

tools/setup.sh build check
for step in ${*:-format clang}; do
  start=$SECONDS
  echo "== $step"
  "step_$step"
  echo "== $step: ok, $((SECONDS - start)) s"
done
