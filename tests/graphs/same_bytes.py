#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""same_bytes.py VELUM GRAPH: one and two threads, another folder and a comma locale write the same."""
import hashlib
import os
import subprocess
import sys
import tempfile


def run(velum, graph, out, threads, **options):
    subprocess.run([velum, "run", graph, "--out", out, "--threads", str(threads), "--no-cache"],
                   check=True, stdout=subprocess.DEVNULL, **options)
    found = {}
    for folder, _, names in os.walk(out):
        for name in names:
            if name != "run.json":
                path = os.path.join(folder, name)
                with open(path, "rb") as file:
                    found[os.path.relpath(path, out)] = hashlib.sha256(file.read()).hexdigest()
    return found


def main():
    velum, graph = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder:
        locale = os.path.join(folder, "de_DE.UTF-8")
        made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", locale], check=False,
                              capture_output=True)
        if not os.path.isdir(locale):
            sys.exit(f"localedef made no German locale: {made.stderr.decode()}")
        one = run(velum, graph, os.path.join(folder, "one"), 1)
        german = dict(os.environ, LOCPATH=folder, LC_ALL="de_DE.UTF-8")
        two = run(velum, graph, os.path.join(folder, "two"), 2, cwd="/", env=german)
    different = sorted(name for name in one.keys() | two.keys() if one.get(name) != two.get(name))
    if len(one) < 3:
        sys.exit(f"only {len(one)} files were written")
    sys.exit(f"different: {', '.join(different)}" if different else 0)


if __name__ == "__main__":
    main()
