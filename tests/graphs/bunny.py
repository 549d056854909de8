#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""bunny.py VELUM DATA: two real scans registered, merged, resampled, meshed, compared.

DATA is the folder of the real data, which is not part of the project; where it is not present, the
test is skipped.
"""
import json
import math
import os
import subprocess
import sys
import tempfile

SKIPPED = 77
HERE = os.path.dirname(os.path.abspath(__file__))


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def moved(shift):
    return [[1, 0, 0, shift[0]], [0, 1, 0, shift[1]], [0, 0, 1, shift[2]], [0, 0, 0, 1]]


def turned(angle, about, shift):
    """A turn about the vertical through a point, then a shift."""
    c, s = math.cos(angle), math.sin(angle)
    turn = [[c, 0, s, 0], [0, 1, 0, 0], [-s, 0, c, 0], [0, 0, 0, 1]]
    return product(moved([about[i] + shift[i] for i in range(3)]),
                   product(turn, moved([-x for x in about])))



def main():
    velum, data = sys.argv[1:3]
    scans = os.path.join(data, "registration", "bunny")
    truth = os.path.join(scans, "truth.json")
    if not os.path.exists(truth):
        print(f"skipped: no {truth}")
        sys.exit(SKIPPED)
    with open(truth, encoding="utf-8") as file:
        pose = json.load(file)["world_from_scan"]["bun045"]
    disturbance = turned(math.radians(10), (-0.03, 0.1, 0.0), (0.012, 0.0, 0.016))
    with tempfile.TemporaryDirectory() as folder:
        start = os.path.join(folder, "start.txt")
        with open(start, "w", encoding="utf-8") as file:
            for row in product(disturbance, pose):
                print(*row, file=file)
        files = {
            "scan_000": os.path.join(scans, "bun000.ply"),
            "scan_045": os.path.join(scans, "bun045.ply"),
            "start": start,
            "true_pose": truth,
            "reference": os.path.join(data, "meshing", "bunny", "bun_zipper.ply"),
        }
        settings = [a for node, file in files.items() for a in ("--set", f"{node}.file={file}")]
        sys.exit(subprocess.run(
            [sys.executable, os.path.join(HERE, "reach.py"), velum,
             os.path.join(HERE, "bunny.toml"), os.path.join(HERE, "bunny.json"), *settings],
            check=False).returncode)


if __name__ == "__main__":
    main()
