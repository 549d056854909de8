#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""demo_table.py NAME=FOLDER...: what runs of the main graph measured, side by side, with the truth."""
import csv
import json
import math
import os
import sys

SAILS = ("gennaker", "mainsail")


def length(value):
    return f"{value:.3f} m"


def short(value):
    return f"{1e3 * value:.2f} mm"


def share(value):
    return f"{100 * value:.2f} %"


def rows_of(sail):
    """The rows of one sail: name, node, measure, how to show it, whether the truth has it."""
    yield f"{sail} found: precision", f"{sail}_found", "precision", share, False
    yield f"{sail} found: recall", f"{sail}_found", "recall", share, False
    yield f"{sail} surface: RMS error", f"{sail}_error", "rms", short, False
    for name in ("luff", "leech", "foot"):
        yield f"{sail} {name}", f"{sail}_shape", name, length, True


class Run:
    def __init__(self, folder):
        with open(os.path.join(folder, "run.json"), encoding="utf-8") as file:
            self.record = json.load(file)
        self.nodes = {node["name"]: node for node in self.record["nodes"]}
        self.folder = folder

    def measure(self, node, name):
        return self.nodes[node]["measures"][name]["value"]

    def shown(self, node, name, show):
        """Nothing where the graph has no such node: only simulated scans have labels."""
        return show(self.measure(node, name)) if node in self.nodes else "-"

    def sections(self, name):
        with open(os.path.join(self.folder, f"{name}.csv"), encoding="utf-8") as file:
            return [{column.split(" [")[0]: float(value) for column, value in row.items()}
                    for row in csv.DictReader(file)]


def main():
    named = [argument.split("=", 1) for argument in sys.argv[1:]]
    runs = [Run(folder) for _, folder in named]
    lines = [["", *(name for name, _ in named), "truth"]]
    lines.append(["pose: rotation off by",
                  *(f"{math.degrees(r.measure('pose_error', 'rotation')):.4f} deg" for r in runs), ""])
    lines.append(["pose: translation off by",
                  *(short(r.measure("pose_error", "translation")) for r in runs), ""])
    for sail in SAILS:
        for title, node, name, show, known in rows_of(sail):
            lines.append([title, *(r.shown(node, name, show) for r in runs),
                          show(runs[0].measure(f"true_{sail}", name)) if known else ""])
        found = [r.sections(sail) for r in runs]
        for i, truth in enumerate(runs[0].sections(f"true_{sail}")):
            for name, unit in (("camber", "%"), ("draft", "%"), ("twist", "deg")):
                lines.append([f"{sail} {name} at {100 * truth['height']:.0f} % height",
                              *(f"{f[i][name]:.2f} {unit}" for f in found),
                              f"{truth[name]:.2f} {unit}"])
    widths = [max(len(line[i]) for line in lines) for i in range(len(lines[0]))]
    print()
    for line in lines:
        print("  " + line[0].ljust(widths[0]),
              *(cell.rjust(width + 2) for cell, width in zip(line[1:], widths[1:])))
    print()


if __name__ == "__main__":
    main()
