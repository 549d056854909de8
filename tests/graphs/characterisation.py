#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""characterisation.py VELUM FOLDER THESIS_TABLES: runs the studies of graphs/characterisation/ and holds
what they find against the thesis's numbers. Skipped without these (exit 77); the studies must still
run.

characterisation.py VELUM FOLDER --recorded: the study of distances on recordings of an emulated scanner.
"""
import csv
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib

MM = 1e-3
velum, folder = sys.argv[1], pathlib.Path(sys.argv[2])
faults = []


def near(what, found, wanted, tolerance):
    if not abs(found - wanted) <= tolerance:
        faults.append(f"{what}: found {found:.6g}, the thesis has {wanted:.6g} (+-{tolerance:.3g})")


def within(what, found, low, high):
    if not low <= found <= high:
        faults.append(f"{what}: found {found:.6g}, the thesis has {low:.6g} to {high:.6g}")


class Study:
    def __init__(self, name, work):
        self.out = pathlib.Path(work) / name
        subprocess.run([velum, "study", folder / f"{name}.toml", "--out", self.out, "--no-cache"],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        variants = json.loads((self.out / "study.json").read_text())["variants"]
        self.means = {}
        self.ids = {}
        for variant in variants:
            assert variant["status"] == "ok", variant
            title = " ".join(variant["axes"].values())
            self.ids[title] = variant["id"]
            self.means[title] = {measure: summary["mean"]
                                 for measure, summary in variant["summary"].items()}

    def get(self, title, measure):
        return self.means[title]["statistics." + measure]

    def all(self, measure):
        return {title: means["statistics." + measure] for title, means in self.means.items()}

    def table(self, title):
        path = next((self.out / "cells" / self.ids[title]).glob("*/statistics.csv"))
        with open(path, encoding="utf-8") as file:
            return [{key.split(" [")[0]: value for key, value in row.items()}
                    for row in csv.DictReader(file)]


def drift(study, thesis):
    hours = study.table("nine_hours")
    printed = thesis["table"][0]["rows"]
    assert len(hours) == len(printed), hours
    for row, (hour, mean, std) in zip(hours, printed):
        near(f"table 2.1, mean of hour {hour} [mm]", float(row["mean"]), mean, 0.25)
        near(f"table 2.1, spread of hour {hour} [mm]", float(row["deviation"]), std, 0.25)
    # Figure 2.14: Gaussian. Figure 2.13: nothing that one would see in two hours.
    within("chance that 150,000 readings are normal", study.get("nine_hours", "normality_p"), 1e-3, 1)
    hourly = [float(row["mean"]) for row in study.table("two_hours")]
    within("drift within two hours [mm]", max(hourly) - min(hourly), 0, 1.0)


def distance(study, thesis):
    sensor = thesis["sensor"]
    errors = list(study.all("error").values())
    shares = list(study.all("error_share").values())
    assert errors == sorted(errors), f"the error must grow with the distance: {errors}"
    assert shares == sorted(shares, reverse=True), f"and fall as a share of it: {shares}"
    near("largest error [%]", 100 * max(shares), sensor["max_distance_error_percent"], 0.02)
    low, high = sensor["std_mm_over_distance"]
    for title, deviation in study.all("deviation").items():
        within(f"spread at {title} [mm]", deviation / MM, low - 0.25, high + 0.25)


def material(study, thesis):
    sensor = thesis["sensor"]
    spreads = study.all("deviation")
    near("spread on reflective cloth [mm]", spreads["reflective"] / MM,
         sensor["std_mm_reflective_tissue"], 0.25)
    near("spread on sail cloth [mm]", spreads["sail"] / MM, sensor["std_mm_sail_tissue"], 0.3)
    assert min(spreads, key=spreads.get) == "reflective", spreads


def colour(study, thesis):
    for name, mean, std, _ in thesis["table"][1]["rows"]:
        near(f"table 2.2, mean on {name} [mm]", study.get(name, "mean") / MM, mean, 0.5)
        near(f"table 2.2, spread on {name} [mm]", study.get(name, "deviation") / MM, std, 0.3)


def incidence(study, thesis):
    limit = thesis["sensor"]["incidence_limit_deg"]
    for title, deviation in study.all("deviation").items():
        angle = int(title.split(", ")[1].split(" ")[0])
        if angle <= limit:
            within(f"spread at {title} [mm]", deviation / MM, 3.5, 4.3)
            assert study.get(title, "readings") == 1000, title
        else:
            within(f"spread at {title} [mm]", deviation / MM, 5.5, 20)
            assert study.get(title, "readings") < 1000, title
    steep = [study.get(f"{d} m, 80 deg", "deviation") for d in (1, 2, 3)]
    assert steep == sorted(steep), f"the effect must grow with the distance: {steep}"


def angulation(study, thesis):
    low, high = thesis["sensor"]["std_mm_over_beam_angle"]
    for title, deviation in study.all("deviation").items():
        within(f"spread of the beam at {title} [mm]", deviation / MM, low - 0.25, high + 0.25)
    for title, error in study.all("error").items():
        angle = int(title.split(" ")[0])
        if angle <= 60:
            within(f"error of the beam at {title} [mm]", error / MM, 0.2, 5)
        elif angle >= 90:
            within(f"error of the beam at {title} [mm]", error / MM, -5, -0.2)


def light(study, thesis):
    spread = {title: {float(row["angle"]): float(row["deviation"]) for row in study.table(title)}
              for title in ("shade", "behind", "direct")}
    usual = sum(spread["shade"].values()) / len(spread["shade"])
    for title, key in (("behind", "sun_behind_sail_std_increase_percent"),
                       ("direct", "sun_on_sensor_std_increase_percent")):
        peak = max(spread[title], key=spread[title].get)
        assert abs(peak - 90) <= 4, f"{title}: the peak is at {peak} degrees, the sun at 90"
        increase = 100 * (spread[title][peak] / usual - 1)
        near(f"increase of the spread, {title} [%]", increase, thesis["sensor"][key],
             12 + 0.05 * thesis["sensor"][key])


def mixed_pixel(study, thesis):
    near_boards = dict(zip(("deep", "shallow"), sorted(thesis["sensor"]["mixed_pixel_target_mm"])))
    wall = thesis["sensor"]["mixed_pixel_background_mm"]
    for title, board in near_boards.items():
        depth = [float(row["mean"]) * math.sin(math.radians(float(row["angle"])))
                 for row in study.table(title)]
        between = [d for d in depth if board + 30 < d < wall - 30]
        within(f"beams between board and wall, {title}", len(between), 2, 12)
    # Against the sky there are none: the beam is lost.
    depth = [float(row["mean"]) for row in study.table("sky")]
    within("farthest reading of the board before the sky [mm]", max(depth), 1000, 1060)


RECORD = """
format = 1
[node.record]
use = "devices.recorder"
address = "ADDRESS"
frequency = 50
resolution = 0.5
view_from = 88
view_to = 92
lines = 400
file = "NAME.vrec"
"""


def record(scanner, name, work):
    """A recording of a scanner that stands before the board."""
    emulator = subprocess.Popen(
        [velum, "emulate", folder / "scenes" / "boards.toml", "--scanner", scanner, "--port", "0",
         "--speed", "0", "--frequency", "50"], stdout=subprocess.PIPE, text=True)
    port = re.search(r"port (\d+) \(host port", emulator.stdout.readline())[1]
    graph = work / "record.toml"
    graph.write_text(RECORD.replace("ADDRESS", f"127.0.0.1:{port}").replace("NAME", name))
    subprocess.run([velum, "run", graph, "--out", work / "recordings"], check=True,
                   stdout=subprocess.DEVNULL)
    emulator.terminate()
    emulator.wait(30)


def recorded():
    with tempfile.TemporaryDirectory() as temporary:
        work = pathlib.Path(temporary)
        shutil.copy(folder / "recorded" / "distance.toml", work)
        for metres in (2, 6):
            record(f"at_{metres}m", f"distance_{metres:02d}m", work)
            shutil.move(work / "recordings" / f"distance_{metres:02d}m.vrec", work)
            shutil.rmtree(work / "recordings")
        (work / "recordings").mkdir()
        for file in work.glob("*.vrec"):
            shutil.move(file, work / "recordings")
        status = subprocess.run([velum, "study", work / "distance.toml", "--out", work / "out"],
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
        assert status == 3, status
        variants = json.loads((work / "out" / "study.json").read_text())["variants"]
    for variant in variants:
        title = variant["axes"]["distance"]
        if title not in ("2 m", "6 m"):
            assert variant["status"] != "ok", title
            continue
        assert variant["status"] == "ok", variant
        metres = int(title.split()[0])
        # The emulator's ranges are whole millimetres.
        near(f"error at {title} [mm]", variant["summary"]["statistics.error"]["mean"] / MM,
             3.4 + metres, 0.6)
        within(f"spread at {title} [mm]",
               variant["summary"]["statistics.deviation"]["mean"] / MM, 3.4, 4.4)


def main():
    if sys.argv[3] == "--recorded":
        recorded()
        sys.exit("\n".join(faults) or 0)
    tables = pathlib.Path(sys.argv[3])
    thesis = tomllib.loads(tables.read_text()) if tables.exists() else None
    with tempfile.TemporaryDirectory() as work:
        for check in (drift, distance, material, colour, incidence, angulation, light, mixed_pixel):
            study = Study(check.__name__, work)
            if thesis:
                check(study, thesis)
    if faults:
        sys.exit("\n".join(faults))
    if not thesis:
        print(f"not compared: {tables} is not there")
        sys.exit(77)


main()
