#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# Runs the main graph and shows what was measured.
set -eu
cd "$(dirname "$0")/.."
out=build/demo
build/release/bin/velum run graphs/wind_tunnel.toml --out "$out" "$@"
python3 tools/demo_table.py "$out/run.json"
echo "results: $PWD/$out"
