#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""examples.py VELUM FOLDER: every example.toml below FOLDER is a graph without mistakes that runs;
one that needs a real scanner is checked only."""
import glob
import os
import subprocess
import sys
import tempfile


def main():
    velum, plugins = sys.argv[1:3]
    examples = sorted(glob.glob(os.path.join(plugins, "*", "*", "example.toml")))
    if not examples:
        sys.exit(f"no examples below {plugins}")
    faults = []
    for example in examples:
        with tempfile.TemporaryDirectory() as folder:
            with open(example, encoding="utf-8") as file:
                scanner = "address = " in file.read()
            command = [velum, "check", example]
            if not scanner:
                command = [velum, "run", example, "--out", os.path.join(folder, "out")]
            run = subprocess.run(command, check=False, capture_output=True, text=True)
        if run.returncode != 0:
            faults.append(f"{example} ended with {run.returncode}:\n{run.stderr[-1500:]}")
    print(f"{len(examples) - len(faults)} of {len(examples)} examples run")
    sys.exit("\n".join(faults) or 0)


if __name__ == "__main__":
    main()
