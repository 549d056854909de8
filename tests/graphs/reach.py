#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""reach.py VELUM GRAPH LIMITS [OPTION...]: runs a graph; its measures must lie within the limits.

LIMITS is JSON: {"node.measure": {"most": x} or {"least": x} or {"is": x}}, in SI units, or
{"file.csv:row:column": ...} for a cell of a table that was written, in the unit of its column. Every
file that a node writes must be there and not empty.
"""
import csv
import json
import os
import subprocess
import sys
import tempfile


def main():
    velum, graph, limits, *options = sys.argv[1:]
    with open(limits, encoding="utf-8") as file:
        wanted = json.load(file)
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out")
        run = subprocess.run([velum, "run", graph, "--out", out, "--no-cache", *options],
                             check=False)
        if run.returncode != 0:
            sys.exit(f"velum run ended with {run.returncode}")
        with open(os.path.join(out, "run.json"), encoding="utf-8") as file:
            record = json.load(file)
        cells = {}
        for name in (f["path"] for f in record["files"] if f["path"].endswith(".csv")):
            with open(os.path.join(out, name), encoding="utf-8") as file:
                for row, line in enumerate(csv.DictReader(file)):
                    cells.update({f"{os.path.basename(name)}:{row}:{column.split(' [')[0]}": float(x)
                                  for column, x in line.items()})
        faults = [f"{f['path']} is empty" for f in record["files"] if f["bytes"] == 0]
        writers = [n for n in record["nodes"] if n["use"].startswith("io.write")]
        if len(record["files"]) < len(writers):
            faults.append(f"{len(writers)} nodes wrote {len(record['files'])} files")
    measures = {
        f"{node['name']}.{name}": measure["value"]
        for node in record["nodes"]
        for name, measure in node["measures"].items()
    } | cells
    for name, limit in wanted.items():
        value = measures.get(name)
        if value is None:
            faults.append(f"{name} was not measured")
        elif value > limit.get("most", value) or value < limit.get("least", value):
            faults.append(f"{name} is {value}, wanted {limit}")
        elif "is" in limit and value != limit["is"]:
            faults.append(f"{name} is {value}, wanted {limit['is']}")
    sys.exit("\n".join(faults) or 0)


if __name__ == "__main__":
    main()
