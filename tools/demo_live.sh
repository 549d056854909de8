#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# Starts two emulated scanners, runs the live graph against them, shows what was measured beside the
# same from the simulator.
set -eu
cd "$(dirname "$0")/.."
velum=build/release/bin/velum
out=build/demo-live
logs=build/emulators
mkdir -p "$logs"

emulators=
trap '[ -z "$emulators" ] || kill $emulators 2> /dev/null || true' EXIT INT TERM
emulate() {
  "$velum" emulate graphs/scenes/wind_tunnel.toml --scanner "$1" --port "$2" \
    > "$logs/$1.log" 2>&1 &
  emulators="$emulators $!"
  tries=0
  until grep -q '^listening' "$logs/$1.log"; do
    tries=$((tries + 1))
    if [ "$tries" -gt 100 ] || ! kill -0 $! 2> /dev/null; then
      cat "$logs/$1.log" >&2
      exit 7
    fi
    sleep 0.1
  done
  cat "$logs/$1.log"
}
emulate gennaker 2111
emulate mainsail 2121
"$velum" run graphs/wind_tunnel_live.toml --out "$out" "$@"
"$velum" run graphs/wind_tunnel.toml --out "$out-simulated" > "$logs/simulated.log" ||
  { cat "$logs/simulated.log"; exit 1; }
python3 tools/demo_table.py "live=$out" "simulated=$out-simulated"
echo "results: $PWD/$out"
