#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# tsan_tbb.sh PREFIX: builds Debian's oneTBB with the thread sanitizer and installs it to PREFIX.
# Debian's own build is not instrumented, so that the sanitizer reports races on correct code.
set -euo pipefail
prefix=$(realpath -m "$1")
[ -e "$prefix/lib/cmake/TBB/TBBConfig.cmake" ] && exit 0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The source packages of the sources that this machine already uses, in an apt state of our own.
mkdir -p "$work/etc" "$work/lists/partial" "$work/cache/archives/partial"
sources=()
for file in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
  if [ -e "$file" ]; then sources+=("$file"); fi
done
for file in "${sources[@]}"; do
  grep -qi debian "$file" || continue
  case $file in
    *.sources) sed -E 's/^Types:.*/Types: deb-src/' "$file" >"$work/etc/$(basename "$file")" ;;
    *) sed -nE 's/^deb /deb-src /p' "$file" >"$work/etc/$(basename "$file" .list).list" ;;
  esac
done
apt_options=(-o "Dir::Etc::sourcelist=/dev/null" -o "Dir::Etc::sourceparts=$work/etc"
  -o "Dir::State::lists=$work/lists" -o "Dir::Cache=$work/cache" -o "APT::Sandbox::User=root")
cd "$work"
apt-get "${apt_options[@]}" update -q >"$work/log" 2>&1 &&
  apt-get "${apt_options[@]}" source -q --only-source onetbb >>"$work/log" 2>&1 || {
  tail -5 "$work/log"
  echo "tsan_tbb: the Debian source of onetbb could not be had; the tsan step needs it" >&2
  exit 1
}
cmake -S "$work"/onetbb-*/ -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR=lib -DTBB_TEST=OFF -DTBBMALLOC_BUILD=OFF \
  -DTBB_STRICT=OFF -DCMAKE_CXX_FLAGS="-fsanitize=thread -Wno-tsan" >>"$work/log" 2>&1
cmake --build "$work/build" >>"$work/log" 2>&1 && cmake --install "$work/build" >>"$work/log" 2>&1 || {
  tail -20 "$work/log"
  exit 1
}
