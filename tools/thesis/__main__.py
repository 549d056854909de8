#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""python3 tools/thesis [--velum FILE] [--out DIR] [--page FILE] [--again]: runs the studies of
graphs/thesis/, checks the thesis's findings on what they measured, and writes docs/thesis.md.

With --again nothing is run: the page is written from what lies in DIR.
"""
import argparse
import datetime
import os
import pathlib
import platform
import sys
import tomllib

import meshing  # noqa: F401
import registration  # noqa: F401
import resampling  # noqa: F401
import segmentation  # noqa: F401
from findings import verdicts_of
from page import Page
from results import Results

ROOT = pathlib.Path(__file__).resolve().parents[2]


def options():
    parser = argparse.ArgumentParser(description="The thesis as studies")
    parser.add_argument("--velum", default=ROOT / "build/release/bin/velum")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/thesis")
    parser.add_argument("--page", type=pathlib.Path, default=ROOT / "docs/thesis.md")
    parser.add_argument("--again", action="store_true")
    return parser.parse_args()


def machine():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            model = next(line.split(":")[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        model = platform.machine()
    return f"{os.cpu_count()} x {model}, {datetime.date.today().isoformat()}"


def main():
    chosen = options()
    with open(ROOT / "graphs/thesis/expected.toml", "rb") as file:
        expected = tomllib.load(file)
    results = Results()
    if chosen.again:
        results.read(chosen.out)
    else:
        graphs = sorted(g for g in (ROOT / "graphs/thesis").glob("*.toml") if g.stem != "expected")
        for k, graph in enumerate(graphs, 1):
            chosen.out.mkdir(parents=True, exist_ok=True)
            results.run(chosen.velum, graph, chosen.out / graph.stem, chosen.out / "cache")
            print(f"[{k}/{len(graphs)}] {graph.stem}: {results.studies[graph.stem].seconds:.0f} s",
                  flush=True)
    verdicts = verdicts_of(expected["finding"], results)
    text = Page(expected, results).text(verdicts, machine())
    chosen.page.write_text(text, encoding="utf-8")
    for verdict in verdicts:
        print(f"{verdict.id} {verdict.word}")
    print(chosen.page)


if __name__ == "__main__":
    sys.exit(main())
