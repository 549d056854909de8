# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""Findings of section 3.4: smoothing."""
from findings import counts, finding, listed, mm, percent


@finding
def f20(r):
    def sphere(measure, *radii):
        return [r("figure_3.48", measure, smooth="pcl_mls", radius=f"{h} mm") for h in radii]

    errors = sphere("error.rms", 100, 225, 300, 400, 500)
    squares = [e * e for e in errors]
    share = (squares[0] - squares[1]) / (squares[0] - min(squares))
    yield (f"of what the squared error falls, {percent(share)} are gained up to 0.9 a.u. (RMS for 0.4, "
           f"0.9, 1.2, 1.6, 2: {listed(errors, mm)})", share > 0.85)
    lost = sphere("smooth.lost", 50, 75, 100)
    yield (f"samples are lost below 0.4 a.u. (0.2, 0.3, 0.4: {counts(lost)})",
           lost[0] > 0 and lost[1] > 0 and lost[2] < 0.01 * lost[0])
    sunk = [r("figure_3.50", "sunk.max", smooth="pcl_mls", radius=f"{h} mm")
            for h in (125, 250, 500, 750, 1000)]
    yield (f"a cone 500 mm high sinks the more the larger h is (h 125 to 1000 mm: {listed(sunk, mm)})",
           sunk == sorted(sunk))
    yield "and is wiped out by a radius of 1 m (more than 400 mm of it)", sunk[-1] > 0.4


@finding
def f21(r):
    for what, before, after, show in (
            ("position", "noisy.rms", "smoothed.rms", mm),
            ("normals", "noisy_form.normal_rms", "smoothed_form.normal_rms", "{:.4f} rad".format),
            ("curvature", "noisy_form.curvature_rms", "smoothed_form.curvature_rms", "{:.2g}".format)):
        values = [r("figure_3.51", m, smooth="pcl_mls") for m in (before, after)]
        yield f"nearer in {what} ({listed(values, show)})", values[1] < values[0]


@finding
def f22(r):
    for study, radii in (("table_3.30", (60, 100, 200, 400, 1000)),
                         ("table_3.31", (175, 275, 500, 750, 1000))):
        moved = [r(study, "moved.mean", smooth="pcl_mls", radius=f"{h} mm") for h in radii]
        yield (f"the mean move grows with h ({study[-4:]}: {listed(moved, mm)})",
               moved == sorted(moved))
    inside, everywhere = (r("table_3.30", m, smooth="pcl_mls", radius="200 mm")
                          for m in ("inside.mean", "moved.mean"))
    yield (f"the border moves most (h 200 mm: mean move inside {mm(inside)}, of all {mm(everywhere)})",
           inside < 0.9 * everywhere)
    alone, pulled = (r("figure_3.55", "error.rms", points=p) for p in ("sail alone", "with the boom"))
    yield (f"leftover points pull the sail's from their place (RMS off the true sail {mm(alone)}, "
           f"{mm(pulled)})", pulled > 1.2 * alone)


@finding
def f23(r):
    raw, smooth = (r("finding_31", "error.back_max", mesh=m, sail="mainsail")
                   for m in ("raw", "resampled"))
    yield ("what is missing of the mainsail is as far from the resampled mesh as from the raw one "
           f"({mm(smooth)}, {mm(raw)})", smooth > 0.8 * raw)
