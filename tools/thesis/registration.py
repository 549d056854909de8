# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""Findings of sections 3.2 and 4.3: two clouds become one. A "right" pose is one within 1 degree and
20 mm (0.1 a.u. of the thesis) of the truth."""
import math

from findings import counts, deg, finding, listed, mm, percent

METHODS = ("point", "plane", "pfh")


def pose(r, study, **labels):
    """(rotation error, translation error)"""
    return r(study, "error.rotation", **labels), r(study, "error.translation", **labels)


def right(found):
    return found[0] < math.radians(1) and found[1] < 0.020


def said(found):
    return f"{deg(found[0])}, {mm(found[1])}"


def poses(r, study, names=METHODS, **labels):
    return {name: pose(r, study, register=name, **labels) for name in names}


def all_said(found):
    return "; ".join(f"{name} {said(f)}" for name, f in found.items())


@finding
def f01(r):
    exact = pose(r, "table_3.01", picks="exact")
    yield (f"exact picks: {said(exact)} off, under 0.001 rad and 0.2 mm (0.001 a.u.)",
           exact[0] < 1e-3 and exact[1] < 2e-4)
    angles, shifts = zip(*(pose(r, "table_3.01", picks=f"noise {k}") for k in range(1, 7)))
    yield (f"noisy picks: the rotation stays within 1 deg ({listed(angles, deg)})",
           max(angles) < math.radians(1))
    yield (f"noisy picks: a shift reaches half of the points' 58 mm (worst of six {mm(max(shifts))})",
           max(shifts) > 0.5 * 0.058)


@finding
def f02(r):
    whole, part = (r("table_3.01", "error.translation", picks=p) for p in ("exact", "exact, a part"))
    yield f"the same result from a part of the points ({mm(whole)} and {mm(part)})", whole == part


@finding
def f03(r):
    found = poses(r, "table_3.05")
    yield f"all three find the pose: {all_said(found)}", all(map(right, found.values()))
    steps, times = ([r("table_3.05", f"register.{m}", register=method) for method in METHODS]
                    for m in ("iterations", "seconds"))
    yield f"plane needs the fewest iterations ({counts(steps)})", steps[1] < min(steps[0], steps[2])
    yield (f"PFH needs the least time ({listed(times, '{:.2f} s'.format)})", times[2] < min(times[:2]))


@finding
def f04(r):
    found = poses(r, "table_3.09", motion="about its middle")
    for name, f in found.items():
        yield f"{name} ends at a wrong pose: {said(f)}", not right(f)
    steps = [r("table_3.09", "register.iterations", register=m, motion="about its middle")
             for m in METHODS]
    yield f"and by its error, before the limit of 200 iterations ({counts(steps)})", max(steps) < 200


@finding
def f05(r):
    found = poses(r, "table_3.13")
    yield f"with noise all three find the pose: {all_said(found)}", all(map(right, found.values()))


@finding
def f06(r):
    near, far = poses(r, "table_3.17", part="source"), poses(r, "table_3.21")
    yield (f"a part against the whole, from 30 deg, is right: {all_said(near)}",
           all(map(right, near.values())))
    yield (f"a part moved farther away is wrong with all three: {all_said(far)}",
           not any(map(right, far.values())))
    much, little = ({o: pose(r, "finding_06", register="point", overlap=o) for o in shares}
                    for shares in (("all", "75 %", "60 %"), ("50 %", "40 %", "30 %")))
    yield (f"point to point is right with more than half in common: {all_said(much)}",
           all(map(right, much.values())))
    yield (f"and wrong with half and less: {all_said(little)}", not any(map(right, little.values())))


@finding
def f07(r):
    found = pose(r, "table_3.04", register="pfh, 500 iterations")
    yield f"PFH-ICP on the raw pair ends {said(found)} off, not at the pose", not right(found)


@finding
def f08(r):
    def refined(measure, method="point, filtered"):
        return r("figure_3.22", measure, register=method)

    before, after = refined("off_before.rms"), refined("off.rms")
    yield (f"rough pose, filter and ICP bring the pair together: from {mm(before)} to {mm(after)}, "
           "within 20 mm", after < 0.020)
    without = refined("off.rms", "point, unfiltered")
    yield f"without the filter ICP does not get there: {mm(without)}", without > 0.020
    few, many = refined("near_before.good"), refined("near.good")
    yield (f"ICP more than doubles the points within 20 mm: {percent(few)}, {percent(many)}",
           many > 2 * few)


@finding
def f09(r):
    found = pose(r, "table_3.23", register="planes")
    yield (f"against its own copy the procedure errs by at most 0.03 mm: {said(found)}",
           found[1] <= 3e-5)


@finding
def f10(r):
    planes = r.variant("finding_10", register="planes")
    yield (f"planes refuses on the water ({planes.status}: {planes.message})",
           planes.status == "failed")
