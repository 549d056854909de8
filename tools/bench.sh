#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# Runs the benchmarks and keeps the table: build/bench/table.md.
set -eu
cd "$(dirname "$0")/.."
VELUM_PLUGIN_PATH=build/bench/plugins build/bench/bin/velum_bench "$@" | tee build/bench/table.md
