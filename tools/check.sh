#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# The long check: `tools/check.sh [STEP...]`, by default format, asan, fuzz, tsan and tidy;
# asan_core (a part of asan), asan_graphs and long by name.
# With CHECK_MINUTES=M a step that its usual time would carry past M minutes is left out, and said so;
# asan_core takes the place of asan where there is time for no more.
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=$(nproc)
fuzz_seconds=${FUZZ_SECONDS:-60}

# Minutes from nothing on 2 cores.
declare -A usual=([format]=1 [asan]=42 [asan_core]=20 [asan_graphs]=8 [fuzz]=8 [tsan]=14 [tidy]=12 [long]=20)

step_format() { tools/format.sh --check; }

step_asan() {  # clang, address and undefined behaviour: kernel, all plugins, their tests
  cmake --preset asan >/dev/null
  cmake --build --preset asan
  ctest --preset asan -LE "long|sdk" -E "^graphs|study_scale|slurm"
}

step_asan_core() {  # what takes in bytes from outside: the kernel, files, devices
  cmake --preset asan >/dev/null
  cmake --build --preset asan --target kernel/all plugins/io/all plugins/devices/all
  ctest --preset asan -LE "long|sdk" -R "^(kernel\.|io\.read|io\.write|devices\.)" \
    -E study_scale  # about size, not about memory
}

step_asan_graphs() {  # the same stages once more, in whole graphs
  cmake --preset asan >/dev/null
  cmake --build --preset asan
  ctest --preset asan -LE long -R "^graphs"
}

step_fuzz() {  # what step_asan has built explores, from its corpus, for a minute each
  cmake --preset asan >/dev/null
  cmake --build --preset asan --target fuzz
  find build/asan/fuzz -maxdepth 1 -type f -executable |
    xargs -P "$jobs" -I{} tools/fuzz.sh {} "$fuzz_seconds"
}

step_tsan() {  # the kernel's threads, with a oneTBB that is itself instrumented
  tools/tsan_tbb.sh build/tsan-tbb || {
    echo "== tsan: LEFT OUT, the source of oneTBB could not be had or built"
    return 0
  }
  cmake --preset tsan -DTBB_DIR="$PWD/build/tsan-tbb/lib/cmake/TBB" >/dev/null
  cmake --build --preset tsan
  ctest --preset tsan -LE long -E "slurm|^docs|study_scale"
}

step_tidy() {  # the kernel, with the flags of the clang build
  cmake --preset asan >/dev/null
  git ls-files 'kernel/src/*.cpp' 'kernel/app/*.cpp' |
    xargs -P "$jobs" -n 4 clang-tidy-14 -p build/asan --quiet
}

step_long() {  # tests of some minutes each
  cmake --build --preset release
  ctest --preset release -L long
}

steps=(${*:-format asan fuzz tsan tidy})
for step in "${steps[@]}"; do
  [ -n "${usual[$step]:-}" ] || {
    echo "check: there is no step '$step' (known: ${!usual[*]})" >&2
    exit 2
  }
done
tools/setup.sh build check
fits() { [ -z "${CHECK_MINUTES:-}" ] || ((SECONDS / 60 + usual[$1] <= CHECK_MINUTES)); }
for step in "${steps[@]}"; do
  if [ "$step" = asan ] && ! fits asan; then
    echo "== asan: asan_core instead, the whole takes ${usual[asan]} minutes"
    step=asan_core
  fi
  if ! fits "$step"; then
    echo "== $step: LEFT OUT, it takes ${usual[$step]} minutes and $((CHECK_MINUTES - SECONDS / 60)) are left"
    continue
  fi
  start=$SECONDS
  echo "== $step"
  "step_$step"
  echo "== $step: ok, $((SECONDS - start)) s"
done
