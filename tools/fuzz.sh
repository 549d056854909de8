#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# fuzz.sh TARGET SECONDS: runs a fuzz target from its corpus; a finding is kept and shown.
set -euo pipefail
target=$1
name=$(basename "$target")
corpus=$(dirname "$0")/../tests/fuzz/corpus/$name
found=$(dirname "$target")  # where a finding is kept
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if ! "$target" "$work" "$corpus" -max_total_time="$2" -max_len=4096 -timeout=10 -rss_limit_mb=2048 \
    -artifact_prefix="$found/" -print_final_stats=1 -verbosity=0 >"$work/log" 2>&1; then
  tail -40 "$work/log"
  echo "fuzz $name: a finding; the input is in $found/"
  exit 1
fi
echo "fuzz $name: $2 s, $(grep -o 'number_of_executed_units: *[0-9]*' "$work/log" | grep -o '[0-9]*$') runs, nothing found"
