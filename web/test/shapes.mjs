// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A gennaker-like sail, sections of which are known, and other things to be seen around it.

const kHeight = 2.1;
const chordAt = (v) => 1.25 * (1 - 0.75 * v ** 1.6);
const camberAt = (v) => 0.17 + 0.05 * v;
const twistAt = (v) => (14 * v * Math.PI) / 180;
const kDraft = 0.44;

const profile = (u) =>
  u < kDraft
    ? (2 * kDraft * u - u * u) / kDraft ** 2
    : (1 - 2 * kDraft + 2 * kDraft * u - u * u) / (1 - kDraft) ** 2;

/** Chord share u from the luff, height share v; metres. */
export function sailPoint(u, v) {
  const chord = chordAt(v);
  const x = chord * u,
    y = chord * camberAt(v) * profile(u);
  const a = twistAt(v);
  return [
    -0.55 + 0.12 * v + x * Math.cos(a) - y * Math.sin(a),
    2.4 + x * Math.sin(a) + y * Math.cos(a),
    -0.95 + kHeight * v,
  ];
}

export function sailGrid(columns, rows, noise) {
  const points = [];
  for (let j = 0; j < rows; ++j)
    for (let i = 0; i < columns; ++i)
      points.push(sailPoint(i / (columns - 1), j / (rows - 1)).map((x) => x + noise()));
  const triangles = [];
  for (let j = 0; j + 1 < rows; ++j)
    for (let i = 0; i + 1 < columns; ++i) {
      const a = j * columns + i;
      triangles.push([a, a + 1, a + columns + 1], [a, a + columns + 1, a + columns]);
    }
  return { points, triangles };
}

export const sectionRows = (heights, off = 0) =>
  heights.map((v) => [
    v,
    -0.95 + kHeight * v,
    chordAt(v) * (1 + off),
    100 * camberAt(v) * (1 - 4 * off),
    100 * kDraft * (1 + 3 * off),
    ((twistAt(v) - twistAt(heights[0])) * 180) / Math.PI,
    36 + 6 * v,
    30 + 5 * v,
  ]);
export const sectionColumns = [
  ["height", ""],
  ["z", "m"],
  ["chord", "m"],
  ["camber", "%"],
  ["draft", "%"],
  ["twist", "deg"],
  ["entry", "deg"],
  ["exit", "deg"],
].map(([name, unit]) => ({ name, unit }));

/** Floor, wall, mast and sail of a wind tunnel with labels: 1 floor, 2 wall, 3 mast, 10 sail. */
export function tunnel(count, rng) {
  const points = [];
  const labels = [];
  const add = (label, share, place) => {
    for (let i = 0; i < count * share; ++i) {
      points.push(place(rng.uniform(), rng.uniform()).map((x) => x + 0.004 * rng.normal()));
      labels.push(label);
    }
  };
  add(1, 0.3, (a, b) => [-2.5 + 5 * a, 0.6 + 4.2 * b, -1.3]);
  add(2, 0.25, (a, b) => [-2.5 + 5 * a, 4.8, -1.3 + 3 * b]);
  add(3, 0.05, (a, b) => [
    0.75 + 0.03 * Math.cos(6.28 * a),
    2.2 + 0.03 * Math.sin(6.28 * a),
    -1.2 + 2.5 * b,
  ]);
  add(10, 0.4, sailPoint);
  return { points, labels };
}
