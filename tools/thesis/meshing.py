# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""Findings of sections 3.5 and 4: surfaces."""
from findings import counts, deg, finding, listed, mm, percent

SAILS = ("gennaker", "mainsail")


@finding
def f24(r):
    def greedy(obj, measure, *mus):
        return [r("figure_3.63", f"quality.{measure}", object=obj, mu=mu) for mu in mus]

    ratios = greedy("plate", "edge_ratio", "1.5", "3", "5")
    yield (f"plate: a larger mu is worse (edge ratios {listed(ratios, '{:.2f}'.format)})",
           ratios[0] < ratios[1] <= ratios[2])
    angles = greedy("model sail", "mean_min_angle", "1.75", "5")
    yield (f"model sail: mu 1.75 is more regular than 5 (mean smallest angle {listed(angles, deg)})",
           angles[0] > angles[1])
    right = r("figure_3.85", "quality.border_length", mesh="auto", sail="gennaker")
    borders = greedy("model sail", "border_length", "1.75", "3", "5")
    lengths = listed(borders, "{:.2f} m".format)
    yield (f"model sail: mu 1.75 leaves the border ragged ({lengths} for mu 1.75, 3, 5; right are "
           f"{right:.2f} m)", borders[0] > 1.1 * right)
    yield "model sail: mu 5 closes it", abs(borders[2] / right - 1) < 0.05
    holes = [r("table_3.32", "quality.holes", mesh=f"{s}'s settings", sail=s) for s in SAILS]
    yield f"holes remain on scanned sails ({counts(holes)})", min(holes) > 0


@finding
def f25(r):
    def noisy(measure, mesh):
        return r("finding_25", f"quality.{measure}", mesh=mesh, object="noisy sail")

    whole = noisy("area", "whole")
    yield f"it fills the hull: {whole:.0f} m² of faces for a sail of 1.8 m²", whole > 18
    manifold = [noisy("manifold", mesh) for mesh in ("trimmed", "trimmed, wide")]
    yield (f"trimmed it is no surface either ({noisy('area', 'trimmed'):.2f} m², manifold "
           f"{counts(manifold)})", max(manifold) == 0)


@finding
def f26(r):
    def poisson(measure, obj, mesh="untrimmed"):
        return r("table_3.33", measure, mesh=mesh, object=obj)

    sixth, closed, sail = (poisson("quality.area", obj) for obj in
                           ("sixth of a cylinder", "closed cylinder", "model sail"))
    yield (f"wings: {sixth:.2f} m² for the sixth of a cylinder (2.62), {sail:.2f} for the sail (1.80)",
           sixth > 2.9 and sail > 2.0)
    off = poisson("error.rms", "closed cylinder")
    yield (f"right for the closed cylinder: {mm(off)} off, {closed:.1f} m² (22.0)",
           off < 0.02 and abs(closed - 22) < 1)
    wide = poisson("error.max", "model sail", "by distance, 4 spacings")
    yield f"trimmed widely false faces stay (as far as {mm(wide)})", wide > 0.02
    loops = poisson("quality.loops", "model sail", "by distance, 1 spacing")
    yield f"trimmed narrowly true ones go ({loops:.0f} loops)", loops > 2


@finding
def f27(r):
    def spline(sail, measure):
        return r("table_3.34", measure, mesh="bspline", sail=sail)

    off, loops = (spline("gennaker", m) for m in ("error.rms", "quality.loops"))
    yield (f"the trimmed gennaker is right: {mm(off)} RMS, {loops:.0f} loop",
           off < 0.002 and loops == 1)
    over = spline("mainsail", "error.rms")
    area = spline("mainsail", "quality.area") / spline("mainsail", "truth.area")
    yield (f"the mainsail with holes at the head fails: {mm(over)} RMS, {percent(area)} of the true area",
           over > 0.02 or not 0.95 < area < 1.05)


@finding
def f28(r):
    planes = ("best plane, trimmed", "scan angles, trimmed")
    for sail in SAILS:
        loops, ratios, angles = ([r("figure_3.85", f"quality.{m}", mesh=p, sail=sail) for p in planes]
                                 for m in ("loops", "edge_ratio", "mean_min_angle"))
        yield f"{sail}: one sheet without holes on either plane ({counts(loops)} loops)", loops == [1, 1]
        alike = all(abs(a / b - 1) < 0.15 for a, b in (ratios, angles))
        yield (f"{sail}: nearly equal triangles (edge ratios {listed(ratios, '{:.2f}'.format)}, "
               f"smallest angles {listed(angles, deg)})", alike)


@finding
def f29(r):
    for jib in ("20 deg", "100 deg"):
        best, angles = (r("finding_29", "error.max", mesh=m, jib=jib)
                        for m in ("best plane", "scan angles"))
        yield (f"a jib twisted by {jib}: triangles on the best plane are as far as {mm(best)} off, on "
               f"the scan angles {mm(angles)}", best > 2 * angles)


@finding
def f30(r):
    def mesh(sail, points):
        off, area, true = (r("finding_30", m, mesh=points, sail=sail)
                           for m in ("error.rms", "quality.area", "truth.area"))
        return off, area / true

    for sail in SAILS:
        (raw, raw_area), (smooth, smooth_area) = mesh(sail, "raw"), mesh(sail, "resampled")
        yield (f"{sail}: raw points {mm(raw)} off and {percent(raw_area)} of the area, resampled ones "
               f"{mm(smooth)} and {percent(smooth_area)}",
               smooth < 0.5 * raw and smooth_area < raw_area)


@finding
def f31(r):
    whole, missing, mended = (r("finding_31", "error.back_max", mesh=m, sail="mainsail") for m in
                              ("nothing missing", "resampled", "repaired, smoothed"))
    yield (f"without grazing returns the mainsail's mesh ends {mm(missing)} from its true end, with "
           f"them {mm(whole)}", missing > 2 * whole)
    yield f"mending and smoothing the mesh leave it so ({mm(mended)})", mended > 0.8 * missing
