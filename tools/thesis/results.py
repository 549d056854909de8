# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""Runs studies and answers what they measured."""
import json
import pathlib
import resource
import subprocess
import sys
import time


def processor_time():
    """Of all ended children and theirs [s]."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Variant:
    """One variant of a study."""

    def __init__(self, data):
        self.axes = data["axes"]
        self.status = data["status"]
        self.message = data["message"]
        self._summary = data["summary"]

    def mean(self, measure):
        """Over the repeats that are ok; None when none measured it."""
        found = self._summary.get(measure)
        return found["mean"] if found else None


class Study:
    """What is in study.json, and what it took: seconds of the clock and of processors."""

    def __init__(self, path, cost):
        self.seconds, self.processor = cost["seconds"], cost["processor"]
        data = json.loads(path.read_text(encoding="utf-8"))
        self.variants = [Variant(variant) for variant in data["variants"]]
        self.repeats = len(data["variants"][0]["runs"])

    def only(self, labels):
        """The one variant that has these labels on its axes."""
        found = [v for v in self.variants if labels.items() <= v.axes.items()]
        if len(found) != 1:
            raise KeyError(f"{len(found)} variants have {labels}, of "
                           f"{[v.axes for v in self.variants]}")
        return found[0]


class Results:
    """The studies of a folder; `results("table_3.05", "error.rotation", register="plane")` is a mean
    in SI units. The name of a study may be shortened to a beginning that only it has."""

    def __init__(self):
        self.studies = {}

    def run(self, velum, graph, out, cache):
        """Runs one; exit 3, some variants failed, is a result too."""
        start, used = time.monotonic(), processor_time()
        done = subprocess.run([velum, "study", graph, "--out", out, "--cache", cache], check=False,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode not in (0, 3):
            sys.exit(f"velum study {graph} ended with {done.returncode}:\n{done.stderr[-2000:]}")
        cost = {"seconds": time.monotonic() - start, "processor": processor_time() - used}
        (out.parent / f"{out.name}.cost.json").write_text(json.dumps(cost), encoding="utf-8")
        self.studies[graph.stem] = Study(out / "study.json", cost)

    def read(self, folder):
        """What an earlier run left in `folder`."""
        folder = pathlib.Path(folder)
        for path in sorted(folder.glob("*/study.json")):
            cost = folder / f"{path.parent.name}.cost.json"
            self.studies[path.parent.name] = Study(path, json.loads(cost.read_text(encoding="utf-8")))

    def study(self, name):
        found = [key for key in self.studies if key == name or key.startswith(name)]
        if len(found) != 1:
            raise KeyError(f"{len(found)} studies are called {name}...")
        return self.studies[found[0]]

    def variant(self, study, **labels):
        return self.study(study).only({k.replace("_", " "): v for k, v in labels.items()})

    def __call__(self, study, measure, **labels):
        variant = self.variant(study, **labels)
        value = variant.mean(measure)
        if value is None:
            raise KeyError(f"{study} {labels} has no {measure}: {variant.status} {variant.message}")
        return value
