#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# Installs the Debian packages that are missing: `tools/setup.sh [build] [check] [bench]`.
set -eu

build="g++ cmake make ninja-build ccache mold git python3 libeigen3-dev libfmt-dev libboost-dev
  libboost-filesystem-dev libcli11-dev nlohmann-json3-dev libtbb-dev libnanoflann-dev libxxhash-dev libzstd-dev
  libtomlplusplus-dev libfast-float-dev liblzf-dev libpng-dev libcgal-dev libpcl-dev
  libopenmesh-dev libocct-data-exchange-dev libocct-modeling-algorithms-dev catch2 locales
  slurm-wlm munge"
check="clang clang-format clang-tidy libclang-rt-14-dev dpkg-dev"
bench="libopen3d-dev"

# report.html is built with npm and tested in Chromium. Debian's npm stays away from a machine that
# has another one: the two do not share their packages.
build="$build chromium"
node -e 'process.exit(parseInt(process.versions.node) < 18 ? 1 : 0)' 2>/dev/null && command -v npm >/dev/null ||
  build="$build nodejs npm"

wanted=""
for group in ${*:-build}; do
  case $group in
    build) wanted="$wanted $build" ;;
    check) wanted="$wanted $check" ;;
    bench) wanted="$wanted $bench" ;;
    *) echo "setup: unknown group '$group' (known: build, check, bench)" >&2; exit 2 ;;
  esac
done

missing=""
for package in $wanted; do
  dpkg-query -W -f '${Status}\n' "$package" 2>/dev/null | grep -q 'ok installed' ||
    missing="$missing $package"
done
[ -z "$missing" ] && exit 0

if [ "$(id -u)" = 0 ]; then run=""
elif command -v sudo >/dev/null; then run="sudo"
else
  echo "setup: these packages are missing:$missing" >&2
  echo "setup: install them as root: apt-get install -y --no-install-recommends$missing" >&2
  exit 1
fi
echo "setup: installing$missing"
export DEBIAN_FRONTEND=noninteractive
# shellcheck disable=SC2086  # one word a package
if ! { $run apt-get update -q && $run apt-get install -qy --no-install-recommends $missing; } \
    >"${TMPDIR:-/tmp}/velum-setup.log" 2>&1; then
  tail -5 "${TMPDIR:-/tmp}/velum-setup.log" >&2
  echo "setup: apt could not install:$missing" >&2
  echo "setup: Velum is built on Debian 12 (bookworm); check the package sources and the network," >&2
  echo "setup: then run this again. The whole log: ${TMPDIR:-/tmp}/velum-setup.log" >&2
  exit 1
fi
