// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Sections as sail makers draw them: each over its chord with camber and draft, and all of them seen
// from the masthead, turned by their twist.
import { css, mapped } from "../colour.js";
import { h, s } from "../dom.js";
import { number, quantity } from "../format.js";
import { curveOf, measuredCurve, turned } from "./shape.js";

const kChord = 460; // of a section's drawing, user units
const kTop = 34;

/** The colour of the i-th section from below, dark on light and light on dark. */
function inkOf(i, count) {
  const share = count < 2 ? 0.4 : i / (count - 1);
  const [light, dark] = [0.08 + 0.72 * share, 0.38 + 0.6 * share].map((t) =>
    css(mapped("viridis", t)),
  );
  return (property) => ({ [property]: light, style: `${property}: light-dark(${light}, ${dark})` });
}
const path = (points) =>
  points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(2)} ${y.toFixed(2)}`).join("");
const percent = (value) => `${number(value, 3)}\u00a0%`;
const degrees = (value) => `${number(value, 3)}\u00b0`;

/**
 * The drawing of one sail. `rows` as from sectionsOf(), lowest first; `sections` the cut curves where
 * there are some; `other` rows to be drawn dashed beside them (a truth or another variant).
 */
export function drawSail(title, rows, sections, other) {
  const curves = rows.map((row) => {
    const cut = sections?.find((section) => Math.abs(section.height - row.height) < 1e-6);
    return cut ? measuredCurve(cut) : curveOf(row);
  });
  return h(
    "figure",
    { class: "sail card" },
    h(
      "figcaption",
      {},
      h("b", {}, title),
      sections ? "" : " \u2013 curves through chord, camber, draft, entry and exit",
    ),
    h(
      "div",
      { class: "sail-parts" },
      h(
        "div",
        { class: "profiles" },
        [...rows.keys()].reverse().map((i) =>
          profile(
            rows[i],
            curves[i],
            inkOf(i, rows.length),
            other?.find((row) => Math.abs(row.height - rows[i].height) < 1e-6),
          ),
        ),
      ),
      h("div", {}, plan(rows, curves, other), table(rows, other)),
    ),
  );
}

/** One section over its chord. */
function profile(row, curve, colour, other) {
  const deep = (Math.max(row.camber, other?.camber ?? 0, 4) / 100) * kChord;
  const base = kTop + deep;
  const at = ([x, y]) => [60 + x * kChord, base - y * kChord];
  const [dx, dy] = at([row.draft / 100, row.camber / 100]);
  const tenths = Array.from({ length: 11 }, (_, i) => 60 + (i * kChord) / 10);
  const label = `height ${percent(100 * row.height)}: chord ${quantity(row.chord, "m")}, camber ${percent(row.camber)}, draft ${percent(row.draft)}${row.twist === undefined ? "" : `, twist ${degrees(row.twist)}`}`;
  return s(
    "svg",
    { class: "section", viewBox: `0 0 580 ${base + 34}`, role: "img", "aria-label": label },
    tenths.map((x, i) =>
      s("line", {
        class: i % 5 ? "tenth" : "half",
        x1: x,
        x2: x,
        y1: base - (i % 5 ? 3 : 5),
        y2: base + (i % 5 ? 3 : 5),
      }),
    ),
    s("line", { class: "chord", x1: 60, x2: 60 + kChord, y1: base, y2: base }),
    other && s("path", { class: "other", d: path(curveOf(other).map(at)) }),
    s("path", { class: "cloth", d: path(curve.map(at)), ...colour("stroke") }),
    s("line", { class: "depth", x1: dx, x2: dx, y1: base, y2: dy }),
    s("circle", { cx: dx, cy: dy, r: 3.2, ...colour("fill") }),
    s(
      "text",
      {
        class: "strong",
        x: dx,
        y: Math.min(dy, base - ((other?.camber ?? 0) * kChord) / 100) - 9,
        "text-anchor": "middle",
      },
      `camber ${percent(row.camber)}`,
    ),
    s("text", { x: dx, y: base + 18, "text-anchor": "middle" }, `draft ${percent(row.draft)}`),
    s("text", { class: "strong", x: 0, y: base + 4 }, percent(100 * row.height)),
    s(
      "text",
      { x: 60 + kChord, y: base + 18, "text-anchor": "end" },
      `chord ${quantity(row.chord, "m")}`,
    ),
    row.entry !== undefined && s("text", { x: 62, y: base + 18 }, `entry ${degrees(row.entry)}`),
    row.exit !== undefined &&
      s("text", { x: 64 + kChord, y: base - 6 }, `exit ${degrees(row.exit)}`),
  );
}

/** All sections from above, luff on luff. */
function plan(rows, curves, other) {
  const lines = rows.map((row, i) => ({
    row,
    colour: inkOf(i, rows.length),
    cloth: turned(curves[i], row),
    chord: turned(
      [
        [0, 0],
        [1, 0],
      ],
      row,
    ),
  }));
  const dashed = (other ?? []).map((row) => turned(curveOf(row), row));
  const points = [...lines.flatMap(({ cloth, chord }) => [...cloth, ...chord]), ...dashed.flat()];
  const [lowX, highX, lowY, highY] = [0, 1].flatMap((axis) => [
    Math.min(...points.map((p) => p[axis])),
    Math.max(...points.map((p) => p[axis])),
  ]);
  const scale = 400 / Math.max(highX - lowX, 1.1 * (highY - lowY), 1e-9);
  const at = ([x, y]) => [20 + (x - lowX) * scale, 24 + (highY - y) * scale];
  const height = 56 + (highY - lowY) * scale;
  return s(
    "svg",
    {
      class: "plan",
      viewBox: `0 0 480 ${height.toFixed(0)}`,
      role: "img",
      "aria-label": `sections from above: ${rows.map((row) => `${percent(100 * row.height)} twist ${degrees(row.twist ?? 0)}`).join(", ")}`,
    },
    s("text", { class: "strong", x: 20, y: 14 }, "from the masthead"),
    dashed.map((curve) => s("path", { class: "other", d: path(curve.map(at)) })),
    lines.map(({ chord, colour }) =>
      s("path", { class: "chord", d: path(chord.map(at)), ...colour("stroke") }),
    ),
    lines.map(({ cloth, colour }) =>
      s("path", { class: "cloth", d: path(cloth.map(at)), ...colour("stroke") }),
    ),
    lines.map(({ row, chord, colour }) => {
      const [x, y] = at(chord[1]);
      return [
        s("circle", { cx: x, cy: y, r: 2.6, ...colour("fill") }),
        s("text", { x: x + 6, y: y + 4 }, row.twist === undefined ? "" : degrees(row.twist)),
      ];
    }),
    s("circle", { cx: at([0, 0])[0], cy: at([0, 0])[1], r: 3.4, class: "luff" }),
    s("text", { x: at([0, 0])[0], y: at([0, 0])[1] + 18 }, "luff"),
    scaleBar(scale, height),
  );
}

function scaleBar(scale, height) {
  const length = [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10].find((x) => x * scale > 50) ?? 10;
  const y = height - 10;
  return s(
    "g",
    { class: "scale-bar" },
    s("path", { d: `M${440 - length * scale} ${y - 4}v4h${length * scale}v-4` }),
    s(
      "text",
      { x: 440 - (length * scale) / 2, y: y - 6, "text-anchor": "middle" },
      quantity(length, "m"),
    ),
  );
}

function table(rows, other) {
  const columns = [
    ["height", "height", (v) => percent(100 * v)],
    ["z", "z", (v) => `${v.toFixed(3)}\u00a0m`],
    ["chord", "chord", (v) => `${v.toFixed(4)}\u00a0m`],
    ["camber", "camber", percent],
    ["draft", "draft", percent],
    ["twist", "twist", degrees],
    ["entry", "entry", degrees],
    ["exit", "exit", degrees],
  ].filter(([key]) => rows[0][key] !== undefined);
  const line = (row, kind) =>
    h(
      "tr",
      { class: kind },
      columns.map(([key, , text], i) =>
        i
          ? h("td", { class: "n" }, text(row[key]))
          : h("th", { scope: "row", class: "n" }, text(row[key])),
      ),
    );
  return h(
    "div",
    { class: "scroll" },
    h(
      "table",
      {},
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          columns.map(([, name]) => h("th", { scope: "col", class: "n" }, name)),
        ),
      ),
      h(
        "tbody",
        {},
        [...rows].reverse().map((row) => line(row)),
      ),
      other &&
        h(
          "tbody",
          { class: "dashed" },
          h(
            "tr",
            {},
            h("th", { colspan: columns.length, class: "note" }, "compared with (dashed)"),
          ),
          [...other].reverse().map((row) => line(row)),
        ),
    ),
  );
}
