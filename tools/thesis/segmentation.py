# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""Findings of section 3.3: what belongs to what."""
from findings import finding, listed, percent

SHAPES = ("plane", "sphere", "cylinder", "cone")


@finding
def f11(r):
    apart = [r("finding_11", f"{s}.iou", parts="without") for s in SHAPES[1:]]
    yield (f"without the plane each object is a cluster (IoU {listed(apart, percent)})",
           min(apart) > 0.95)
    merged = r("finding_11", "parts.clusters", parts="with the plane")
    yield f"with it all is one ({merged:.0f} clusters)", merged == 1


@finding
def f12(r):
    def pcl(measure, shape):
        return r("table_3.24", measure, parts=f"pcl_ransac, {shape}")

    for shape in SHAPES:
        found = pcl(f"{shape}.recall", shape)
        yield f"PCL's RANSAC finds the {shape}, 85 % and more of it ({percent(found)})", found >= 0.85
    times = [pcl("parts.seconds", shape) for shape in SHAPES]
    yield f"the cone takes longest ({listed(times, '{:.2f} s'.format)})", times[3] == max(times)
    precision = pcl("plane.precision", "plane")
    yield f"the plane takes points of others (precision {percent(precision)})", precision < 0.999


@finding
def f13(r):
    def pcl(shape, measure, epsilon, noise):
        return r("figure_3.26", f"{shape}.{measure}", parts=f"pcl_ransac, {shape}",
                 epsilon=epsilon, noise=noise)

    false = [pcl("cone", "iou", epsilon, "0 mm") for epsilon in ("8 mm", "60 mm", "100 mm")]
    yield (f"too large an epsilon gives a false shape (IoU of the cone at 8, 60, 100 mm: "
           f"{listed(false, percent)})", false[2] < 0.5)
    sphere, *others = (pcl(shape, "recall", "8 mm", "10 mm") for shape in SHAPES[1:])
    yield (f"with noise cylinder and cone are lost (recall {listed(others, percent)})",
           max(others) < 0.5)
    wide = pcl("sphere", "recall", "60 mm", "10 mm")
    yield (f"a larger epsilon saves the sphere (recall {percent(sphere)} to {percent(wide)})",
           wide > max(0.9, sphere))
    first = [r("finding_13", f"{s}.recall", parts="pcl_ransac", epsilon="8 mm")
             for s in ("smallest", "small", "large", "largest")]
    yield ("of four cones with equal counts the smallest comes first (recall from the smallest: "
           f"{listed(first, percent)})", first[0] == max(first) and first[0] > 0.5)


@finding
def f14(r):
    for shape, wanted in (("sphere", "found"), ("cone", "found"), ("cylinder", "not found")):
        recall = r("finding_14", "score.recall", parts="pcl_ransac", shape=shape)
        yield (f"of two thirds of it the {shape} is {wanted} (recall {percent(recall)})",
               (recall > 0.8) == (wanted == "found"))


@finding
def f15(r):
    best = max(r("table_3.25", "score.iou", parts=f"{stage}, {model}", sail=sail)
               for stage in ("pcl_ransac", "ransac") for model in ("cylinder", "cone")
               for sail in ("gennaker", "mainsail"))
    yield f"no cylinder or cone is a sail (IoU at most {percent(best)})", best < 0.6


@finding
def f16(r):
    def iou(parts, noise):
        return [r("table_3.26", f"{s}.iou", parts=parts, noise=noise) for s in SHAPES]

    for parts, whose in (("thesis", "the thesis's"), ("region growing", "our")):
        found = iou(parts, "0 mm")
        yield (f"with {whose} settings plane, sphere and cylinder come apart, above 77, 97, 98 % "
               f"(IoU {listed(found[:3], percent)})",
               found[0] > 0.77 and found[1] > 0.97 and found[2] > 0.98)
    yield f"with our settings the cone is worst ({percent(found[3])})", found[3] == min(found)
    change = max(abs(a - b) for a, b in zip(found, iou("region growing", "4 mm")))
    yield (f"with our settings noise hardly changes it (by {percent(change)} at most)", change < 0.05)


@finding
def f17(r):
    def score(study, sail, settings):
        return [r(study, f"score.{m}", parts=f"{settings}'s settings", sail=sail)
                for m in ("recall", "precision")]

    found = [score("table_3.28", "jib", "gennaker"), score("table_3.28", "mainsail", "mainsail"),
             score("table_3.29", "gennaker", "gennaker"), score("table_3.29", "mainsail", "mainsail")]
    recall, precision = zip(*found)
    yield (f"89 % and more of each sail's points ({listed(recall, percent)})", min(recall) >= 0.89)
    missing, extra = (1 - sum(shares) / len(shares) for shares in (recall, precision))
    yield (f"extra points are more than missing ones ({percent(extra)} to {percent(missing)} on the "
           "mean)", extra > missing)


@finding
def f18(r):
    def smoothness(angle):
        return [r("figure_3.33", m, smoothness=f"{angle} deg")
                for m in ("plane.iou", "sphere.iou", "parts.clusters")]

    plane, sphere, _ = smoothness("1")
    yield (f"1 deg: the plane alone (IoU {percent(plane)}, sphere {percent(sphere)})",
           plane > 0.8 and sphere < 0.5)
    plane, sphere, _ = max((smoothness(a) for a in ("2.25", "5", "12", "20")),
                           key=lambda found: min(found[:2]))
    yield f"between, both (IoU {percent(plane)}, {percent(sphere)})", min(plane, sphere) > 0.9
    clusters = smoothness("40")[2]
    yield f"40 deg: all is one ({clusters:.0f} clusters)", clusters == 1

    thresholds = "0.0002 0.0005 0.001 0.002 0.005 0.01 0.02 0.05 0.1 0.33".split()
    spheres = [r("figure_3.35", "sphere.iou", curvature=c) for c in thresholds]
    yield (f"curvature: the sphere is in pieces below (IoU {percent(spheres[0])}), whole between "
           f"({percent(max(spheres))})", spheres[0] < 0.5 and max(spheres) > 0.9)
    clusters = r("figure_3.35", "parts.clusters", curvature="0.33")
    yield f"curvature: off, all is one ({clusters:.0f} clusters)", clusters == 1


@finding
def f19(r):
    def corner(measure, neighbours, smoothness, noise):
        return r("finding_19", measure, normals_over=neighbours, smoothness=smoothness, noise=noise)

    strip = 1 - corner("parts.assigned", "100", "7 deg", "0 mm")
    yield f"over 100 neighbours a strip at the corner is not assigned ({percent(strip)})", strip > 0.005
    few, many = ([min(corner(plane, n, angle, "4 mm") for plane in ("floor.iou", "wall.iou"))
                  for angle in ("3 deg", "7 deg", "15 deg", "30 deg")] for n in ("5", "100"))
    yield (f"with noise more thresholds do over 100 neighbours than over 5 (worse plane's IoU at 3, 7, "
           f"15, 30 deg: {listed(many, percent)}; {listed(few, percent)})",
           sum(x > 0.8 for x in many) > sum(x > 0.8 for x in few))
