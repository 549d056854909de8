// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { choice, h } from "../dom.js";
import { quantity } from "../format.js";
import { drawSail } from "./draw.js";
import { sectionsOf } from "./shape.js";

const kSizes = ["luff", "leech", "foot", "area"];

/** The sails of a run: one drawing for each table of sections; null where there is none. */
export function sailSection(report) {
  const tables = report.values
    .map((value) => ({ value, rows: sectionsOf(value) }))
    .filter(({ rows }) => rows);
  if (tables.length === 0) return null;
  const node = (value) => report.run.nodes.find((one) => one.name === value.node);
  const isTruth = ({ value }) => node(value)?.use === "devices.truth";
  const measured = tables.filter((table) => !isTruth(table));
  return (measured.length ? measured : tables).map((table) =>
    sail(table, tables, node(table.value), isTruth),
  );
}

function sail(table, tables, node, isTruth) {
  const { value, rows } = table;
  const others = tables.filter((other) => other !== table);
  const holder = h("div", {});
  const draw = (id) =>
    holder.replaceChildren(
      drawSail(
        value.node,
        rows,
        value.sections,
        others.find((other) => other.value.id === id)?.rows,
      ),
    );
  const start = likeliest(table, others.filter(isTruth))?.value.id ?? "";
  draw(start);
  const sizes = kSizes
    .filter((name) => node?.measures?.[name])
    .map((name) =>
      h(
        "span",
        {},
        h("small", {}, name),
        " ",
        h("b", {}, quantity(node.measures[name].value, node.measures[name].unit)),
      ),
    );
  return h(
    "div",
    { class: "one-sail" },
    h(
      "div",
      { class: "tools" },
      h("h3", {}, value.node),
      h("p", { class: "sizes" }, sizes),
      others.length > 0 &&
        choice(
          "beside it, dashed:",
          [["", "nothing"], ...others.map((other) => [other.value.id, other.value.id])],
          start,
          draw,
        ),
    ),
    holder,
  );
}

/** The truth of the same sail: the one whose sections are nearest in height and chord. */
function likeliest({ rows }, truths) {
  const off = (other) =>
    rows.reduce((sum, row) => {
      const same = other.rows.find((one) => Math.abs(one.height - row.height) < 1e-6);
      return sum + (same ? Math.abs(same.chord - row.chord) / row.chord : 1);
    }, 0) / rows.length;
  const best = truths.map((other) => ({ other, off: off(other) })).sort((a, b) => a.off - b.off)[0];
  return best && best.off < 0.1 ? best.other : null;
}
