// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Parts that need no browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { number, quantity, scaleFor } from "../src/format.js";
import { layOut, wiresOf } from "../src/graph/layout.js";
import { logAxis } from "../src/plots/axis.js";
import { curveOf, measuredCurve, turned } from "../src/sails/shape.js";
import { numericAxis } from "../src/study/model.js";
import { front } from "../src/study/pareto.js";
import { cleaningToml, picksToml } from "../src/view3d/toml.js";

const kRow = { height: 0.5, chord: 2, camber: 12, draft: 45, twist: 10, entry: 30, exit: 20 };

test("a section has its camber at its draft, its chord's ends and its angles", () => {
  const curve = curveOf(kRow, 200);
  const deepest = curve.reduce((best, point) => (point[1] > best[1] ? point : best));
  assert.ok(Math.abs(deepest[0] - 0.45) < 1e-9 && Math.abs(deepest[1] - 0.12) < 1e-9);
  assert.deepEqual(
    [curve[0], curve.at(-1)[0], Math.abs(curve.at(-1)[1]) < 1e-12],
    [[0, 0], 1, true],
  );
  const slope = (a, b) => (Math.atan2(b[1] - a[1], b[0] - a[0]) * 180) / Math.PI;
  assert.ok(Math.abs(slope(curve[0], curve[1]) - 30) < 1);
  assert.ok(Math.abs(slope(curve.at(-2), curve.at(-1)) + 20) < 1);
});

test("twist turns the chord and keeps its length", () => {
  const [x, y] = turned([[1, 0]], kRow)[0];
  assert.ok(Math.abs(Math.hypot(x, y) - 2) < 1e-12);
  assert.ok(Math.abs((Math.atan2(y, x) * 180) / Math.PI - 10) < 1e-9);
});

test("a measured section is put on its chord, the deep side up", () => {
  const points = [
    [1, 1, 5],
    [1, 2, 4.7],
    [1, 3, 5],
  ];
  const curve = measuredCurve({ points, chord: [points[0], points[2]] });
  assert.deepEqual(
    curve.map((p) => p.map((x) => Math.round(1000 * x) / 1000)),
    [
      [0, 0],
      [0.5, 0.15],
      [1, 0],
    ],
  );
});

test("the front has what no other point beats, for each direction", () => {
  const points = [
    { x: 1, y: 5 },
    { x: 2, y: 3 },
    { x: 3, y: 4 },
    { x: 4, y: 1 },
    { x: 2, y: 6 },
  ];
  assert.deepEqual(front(points, "lower", "lower"), [points[0], points[1], points[3]]);
  assert.deepEqual(front(points, "higher", "lower"), [points[3]]);
  assert.deepEqual(front(points, "lower", "higher"), [points[0], points[4]]);
  assert.equal(front(points, "lower", "neither"), null);
});

test("an axis is numeric when all its values are numbers in one unit", () => {
  assert.equal(numericAxis({ values: ["80 mm", "120 mm"] }).at.get("120 mm"), 120);
  assert.equal(numericAxis({ values: ["80 mm", "1 m"] }), null);
  assert.equal(numericAxis({ values: ["a.pcd", "b.pcd"] }), null);
});

test("numbers are written for people", () => {
  assert.equal(quantity(0.00065, "m"), "0.65\u00a0mm");
  assert.equal(quantity(Math.PI / 2, "rad"), "90\u00b0");
  assert.equal(number(-1234567), "\u22121\u202f234\u202f567");
  assert.equal(number(7.1e-8, 2), "7.1\u00b710\u207b\u2078");
  assert.equal(number(null), "\u2013");
  assert.deepEqual(scaleFor("s", 1200), { factor: 1 / 60, unit: "min" });
});

test("logarithmic ticks are round, and zero has none", () => {
  const axis = logAxis([0.9, 30]);
  assert.ok(
    [1, 2, 5, 10, 20].every((x) => axis.tickvals.some((tick) => Math.abs(tick - x) < 1e-9)),
  );
  assert.deepEqual(logAxis([0, 1]), { type: "linear" });
});

const node = (name, ...from) => ({
  name,
  in: { in: from.map((one) => ({ from: `${one}.cloud`, type: "cloud" })) },
});

test("nodes lie after those that they depend on and do not overlap", () => {
  const nodes = [
    node("a"),
    node("b", "a"),
    node("c", "a"),
    node("d", "b", "c"),
    node("e", "a", "d"),
    node("f", "c"),
  ];
  const wires = wiresOf(nodes);
  assert.equal(wires.length, 7);
  const { at, routes } = layOut(nodes, wires, { size: 50, gap: 10, thin: 5 });
  for (const { from, to } of wires)
    assert.ok(at.get(from).layer < at.get(to).layer, `${from} to ${to}`);
  const places = [...at.values()];
  for (const a of places)
    for (const b of places)
      assert.ok(a === b || a.layer !== b.layer || Math.abs(a.across - b.across) >= 59.99);
  assert.equal(routes.get(wires.find(({ from, to }) => from === "a" && to === "e")).length, 4);
});

test("wires find nodes whose names have dots", () => {
  const nodes = [
    node("a.b"),
    {
      name: "c",
      in: { in: { from: "a.b", type: "cloud" }, other: { from: "a.b.mesh", type: "mesh" } },
    },
  ];
  assert.deepEqual(
    wiresOf(nodes).map(({ from, output }) => [from, output]),
    [
      ["a.b", ""],
      ["a.b", "mesh"],
    ],
  );
});

const picked = (id, ...point) => ({
  value: { id, node: id.split(".")[0], type: id.split(".")[1] },
  index: 3,
  point,
});

test("picks become pairs, source and target as the graph has them", () => {
  const list = [picked("b.cloud", 1, 2, 3), picked("a.cloud", 4, 5, -0.000001)];
  const nodes = [
    { name: "register", in: { source: { from: "a.cloud" }, target: { from: "b.cloud" } } },
  ];
  assert.match(
    picksToml(list, nodes),
    /source = \["4.00000 m", "5.00000 m", "0.00000 m"\], target = \["1.00000 m"/,
  );
  assert.match(picksToml(list, []), /source = \["1.00000 m"/);
  assert.equal(picksToml(list.slice(1), nodes), null);
});

test("picks in a mesh are removed from the cloud that it was made of", () => {
  const nodes = [
    { name: "mesh", in: { cloud: { from: "smooth.cloud", type: "cloud" } } },
    { name: "repaired", in: { mesh: { from: "mesh.mesh", type: "mesh" } } },
    { name: "truth", in: {} },
  ];
  assert.match(
    cleaningToml([picked("repaired.mesh", 1, 2, 3)], nodes),
    /^\[node\.smooth_cleaned\]\n.*\nin = "smooth\.cloud" {2}# of which repaired\.mesh was made\n/,
  );
  assert.match(
    cleaningToml([picked("truth.mesh", 1, 2, 3)], nodes),
    /^# truth\.mesh was made of no cloud/,
  );
});

test("picks become a node that removes them", () => {
  assert.match(
    cleaningToml([picked("my scan.cloud", 1, 2, 3)]),
    /^\[node\."my scan_cleaned"\]\nuse = "filtering.remove_points"\nin = "my scan.cloud"\npoints = \[\n {2}\["1.00000 m"/,
  );
});
