#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# fetch.sh NPM: installs what package-lock.json names into node_modules, for one build at a time.
set -eu
npm=$1
cd "$(dirname "$0")"
exec 9>.fetch.lock
flock 9
done=node_modules/.package-lock.json
if [ -e "$done" ] && [ "$done" -nt package-lock.json ] && [ "$done" -nt package.json ]; then
  exit 0
fi
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! "$npm" ci --ignore-scripts --no-audit --no-fund --prefer-offline >"$log" 2>&1; then
  tail -5 "$log" >&2
  echo "web: npm could not fetch the packages of report.html. Is its registry reachable (npm ping)?" >&2
  echo "web: then build again; or build without the report: cmake --preset release -DVELUM_REPORT=OFF" >&2
  exit 1
fi
touch "$done"
