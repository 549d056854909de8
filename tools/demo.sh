#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# Runs the main graph, and again with scans at the thesis's 0.5 degrees; shows what was measured.
set -eu
cd "$(dirname "$0")/.."
velum=build/release/bin/velum
out=build/demo
report=--report
[ -f build/release/share/velum/report.html ] || {
  echo "no report.html: its page was not built (node and npm)" >&2
  report=
}
"$velum" run graphs/wind_tunnel.toml --out "$out" $report "$@"
"$velum" run graphs/wind_tunnel.toml --out "$out-half-degree" $report "$@" \
  $(cat graphs/half_degree.options) > build/demo-half-degree.log || { cat build/demo-half-degree.log; exit 1; }
python3 tools/demo_table.py "0.25 deg=$out" "0.5 deg=$out-half-degree"
echo "results: $PWD/$out"
[ -z "$report" ] || echo "report:  $PWD/$out/report.html, and $PWD/$out-half-degree/report.html"
