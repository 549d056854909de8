// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// The curve of a sail's section, in shares of its chord: x from luff to leech, y to leeward.

/** Rows of a table of sections, or null: needs height, chord, camber and draft. */
export function sectionsOf(value) {
  const names = value.rows?.columns.map((column) => column.name) ?? [];
  if (!["height", "chord", "camber", "draft"].every((name) => names.includes(name))) return null;
  const rows = value.rows.rows.map((row) =>
    Object.fromEntries(names.map((name, i) => [name, row[i]])),
  );
  return rows.length ? rows.sort((a, b) => a.height - b.height) : null;
}

const slope = (degrees) => Math.tan((Math.min(Math.abs(degrees), 85) * Math.PI) / 180);

/**
 * The section drawn from its figures: two cubic pieces that meet at the draft with the camber and a
 * level tangent, and leave the edges at the entry and exit angles.
 */
export function curveOf(row, steps = 40) {
  const draft = row.draft / 100;
  const camber = row.camber / 100;
  const entry = row.entry === undefined ? (2 * camber) / draft : slope(row.entry);
  const exit = row.exit === undefined ? (2 * camber) / (1 - draft) : slope(row.exit);
  const points = [];
  for (let i = 0; i <= steps; ++i) points.push(hermite(0, 0, entry, draft, camber, 0, i / steps));
  for (let i = 1; i <= steps; ++i) points.push(hermite(draft, camber, 0, 1, 0, -exit, i / steps));
  return points;
}

function hermite(x0, y0, m0, x1, y1, m1, t) {
  const width = x1 - x0;
  const t2 = t * t,
    t3 = t2 * t;
  return [
    x0 + t * width,
    (2 * t3 - 3 * t2 + 1) * y0 +
      (t3 - 2 * t2 + t) * width * m0 +
      (3 * t2 - 2 * t3) * y1 +
      (t3 - t2) * width * m1,
  ];
}

/** A cut curve of points as [x, y] in shares of the chord; the cambered side is up. */
export function measuredCurve(section) {
  const [luff, leech] = section.chord;
  const along = leech.map((x, axis) => x - luff[axis]);
  const length = Math.hypot(...along);
  const unit = along.map((x) => x / length);
  const off = section.points.map((point) => point.map((x, axis) => x - luff[axis]));
  const x = off.map((d) => d[0] * unit[0] + d[1] * unit[1] + d[2] * unit[2]);
  const away = off.map((d, i) => d.map((c, axis) => c - x[i] * unit[axis]));
  const deepest = away.reduce(
    (best, d) => (Math.hypot(...d) > Math.hypot(...best) ? d : best),
    [0, 0, 0],
  );
  const depth = Math.hypot(...deepest) || 1;
  const up = deepest.map((c) => c / depth);
  return x.map((at, i) => [
    at / length,
    (away[i][0] * up[0] + away[i][1] * up[1] + away[i][2] * up[2]) / length,
  ]);
}

/** [x, y] of the chord's share turned by the twist and set to length, luff at the origin, metres. */
export function turned(points, row) {
  const angle = ((row.twist ?? 0) * Math.PI) / 180;
  return points.map(([x, y]) => [
    row.chord * (x * Math.cos(angle) - y * Math.sin(angle)),
    row.chord * (x * Math.sin(angle) + y * Math.cos(angle)),
  ]);
}
