#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""comparison.py RUN.json NODE.MEASURE...: methods that ran side by side, as a Markdown table.

A method is a node METHOD for which there are nodes METHOD_<what> that measure it: the column
`error.rms` is the measure `rms` of the node METHOD_error; `.iterations` is one of the method's own.
"""
import json
import math
import sys


def show(measure):
    value, unit = measure["value"], measure["unit"]
    if unit == "rad":
        return f"{math.degrees(value):.3f}°"
    if unit == "m" and abs(value) < 0.5:
        return f"{1e3 * value:.2f} mm"
    return f"{value:.4g} {unit}".rstrip()


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        nodes = {node["name"]: node for node in json.load(file)["nodes"]}
    columns = [column.split(".") for column in sys.argv[2:]]
    print("| method | stage | " + " | ".join(f"{what} {name}".strip() for what, name in columns)
          + " | time |")
    print("|---|---|" + "--:|" * (len(columns) + 1))
    for name, node in nodes.items():
        cells = []
        for what, measure in columns:
            of = nodes.get(f"{name}_{what}" if what else name, {"measures": {}})["measures"]
            cells.append(show(of[measure]) if measure in of else "")
        measured = any(f"{name}_{what}" in nodes for what, _ in columns if what)
        if measured:
            print(f"| {name} | {node['use']} | " + " | ".join(cells)
                  + f" | {node['seconds']:.2f} s |")


if __name__ == "__main__":
    main()
