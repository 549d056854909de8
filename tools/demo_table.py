#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""Prints the measures of a record that a reader of the demo looks for first."""
import json
import math
import sys


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        record = json.load(file)
    print(f"\n{record['graph']['title']}: {record['status']} in {record['seconds']:.2f} s\n")
    wanted = {
        "registration_error": ["rotation", "translation"],
        "segmentation_score": ["precision", "recall"],
        "mesh_to_reference": ["rms", "p95"],
        "mesh_quality": ["holes", "loops", "manifold"],
        "sail_shape": ["luff", "leech", "foot", "area"],
    }
    for node in record["nodes"]:
        names = wanted.get(node["use"].split(".")[1], [])
        shown = [f"{n} {show(node['measures'][n])}" for n in names if n in node["measures"]]
        if shown:
            print(f"  {node['name']:<22} {', '.join(shown)}")


def show(measure):
    value, unit = measure["value"], measure["unit"]
    if unit == "rad":
        return f"{math.degrees(value):.4f} deg"
    if unit == "m" and abs(value) < 0.1:
        return f"{1e3 * value:.2f} mm"
    return f"{value:.4g} {unit}".rstrip()


if __name__ == "__main__":
    main()
