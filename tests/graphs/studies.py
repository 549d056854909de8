# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""studies.py VELUM FOLDER [--run]: every study of graphs/studies/ is a sound one, has a reference, and
repeats that allow of a significance; with --run each is run and ends as it should."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib


def sound(velum, study):
    """Without mistakes, and compared as the page on studies says."""
    out = subprocess.run([velum, "check", study], check=True, capture_output=True, text=True).stdout
    cells = int(re.search(r"= (\d+) cells", out).group(1))
    assert cells <= 200, f"{study}: {cells} cells are no matter of minutes"
    with open(study, "rb") as file:
        text = tomllib.load(file)["study"]
    # Wilcoxon's test reaches 2 / 2^n at best, and Holm multiplies by the number of comparisons.
    best = 2 / 2 ** text["repeat"] * (cells // text["repeat"])
    assert best < 0.05, f"{study}: too few repeats for anything to be significant"
    assert "reference" in text, f"{study}: nothing that the others are compared with"


class Result:
    """What a study measured: `mean("error.rms", smooth="mls", noise="4 mm")`."""

    def __init__(self, velum, study, work):
        out = work / study.stem
        subprocess.run([velum, "study", study, "--out", out], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.variants = json.loads((out / "study.json").read_text(encoding="utf-8"))["variants"]
        assert all(v["status"] == "ok" for v in self.variants), \
            [(v["axes"], v["status"], v["message"]) for v in self.variants if v["status"] != "ok"]

    def values(self, axis):
        return list(dict.fromkeys(v["axes"][axis] for v in self.variants))

    def summary(self, measure, **axes):
        found = [v for v in self.variants if axes.items() <= v["axes"].items()]
        assert len(found) == 1, (axes, len(found))
        return found[0]["summary"][measure]

    def mean(self, measure, **axes):
        return self.summary(measure, **axes)["mean"]


def resampling(r):
    """Planes flatten the sail the more, the wider they look; curved pieces are best in between."""
    radii = r.values("radius")
    rms = {(h, o): r.mean("error.rms", radius=h, order=o) for h in radii for o in r.values("order")}
    best = min(rms, key=rms.get)
    assert rms[best] < 0.8e-3, "the best must be under 0.8 mm"
    assert rms[radii[-1], "1"] > 10 * rms[best]
    assert best[0] not in (radii[0], radii[-1])
    assert r.summary("error.rms", radius=radii[-1], order="1")["difference"]["p"] < 0.05


def resampling_methods(r):
    """Border-aware moving least squares are the most accurate of those that keep the points."""
    for noise in r.values("noise"):
        aware = r.mean("error.rms", smooth="mls, border aware", noise=noise)
        for other in ("cgal_bilateral", "cgal_wlop", "voxel_grid"):
            assert aware < r.mean("error.rms", smooth=other, noise=noise), (noise, other)
    assert r.mean("error.rms", smooth="mls, border aware", noise="4 mm") < 1.0e-3


def registration(r):
    """What needs no start is within 2 mm, nearer than ICP from picked pairs."""
    for method in ("planes", "global"):
        assert r.mean("error.translation", register=method) < 2e-3, method
        assert r.mean("error.rotation", register=method) < 0.00087, method
    assert r.mean("error.translation", register="icp, symmetric") < 2e-3
    worse = r.summary("error.translation", register="icp to points")
    assert worse["mean"] > 2e-3 and worse["difference"]["p"] < 0.05


def segmentation(r):
    """RANSAC finds all four shapes with any of the noises; distances alone find none."""
    for noise in r.values("noise"):
        for shape in ("plane", "sphere", "cylinder", "cone"):
            assert r.mean(f"{shape}.iou", parts="ransac", noise=noise) > 0.95, (shape, noise)
        assert r.mean("sphere.iou", parts="euclidean", noise=noise) < 0.5, noise


def meshing(r):
    for radius in r.values("radius"):
        assert r.mean("quality.holes", mesh="delaunay_projected", radius=radius) == 0
        assert r.mean("error.rms", mesh="delaunay_projected", radius=radius) < 2e-3


def meshing_methods(r):
    """One sheet from the projection and the spline, which is nearest; from 3-D Delaunay none."""
    for sail in r.values("sail"):
        for method in ("delaunay_projected", "bspline"):
            assert r.mean("quality.holes", mesh=method, sail=sail) == 0, (method, sail)
            assert r.mean("quality.manifold", mesh=method, sail=sail) == 1, (method, sail)
        assert r.mean("quality.manifold", mesh="delaunay_3d", sail=sail) == 0, sail
        assert r.mean("error.rms", mesh="bspline", sail=sail) < \
            r.mean("error.rms", mesh="delaunay_projected", sail=sail), sail


def main():
    velum, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    expectations = [resampling, resampling_methods, registration, segmentation, meshing, meshing_methods]
    studies = sorted(folder.glob("*.toml"))
    assert {s.stem for s in studies} == {e.__name__ for e in expectations}, studies
    for study in studies:
        sound(velum, study)
    if "--run" not in sys.argv:
        return
    faults = []
    with tempfile.TemporaryDirectory() as work:
        for expect in expectations:
            try:
                expect(Result(velum, folder / f"{expect.__name__}.toml", pathlib.Path(work)))
            except (AssertionError, subprocess.CalledProcessError) as fault:
                faults.append(f"{expect.__name__}: {fault!r}")
            print(f"{expect.__name__} done", flush=True)
    sys.exit("\n".join(faults) or 0)


if __name__ == "__main__":
    main()
