#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# Runs the main graph, and again with scans at the thesis's 0.5 degrees; shows what was measured.
set -eu
cd "$(dirname "$0")/.."
velum=build/release/bin/velum
out=build/demo
"$velum" run graphs/wind_tunnel.toml --out "$out" "$@"
"$velum" run graphs/wind_tunnel.toml --out "$out-half-degree" "$@" $(cat graphs/half_degree.options) \
  > build/demo-half-degree.log || { cat build/demo-half-degree.log; exit 1; }
python3 tools/demo_table.py "0.25 deg=$out" "0.5 deg=$out-half-degree"
echo "results: $PWD/$out"
