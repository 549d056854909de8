// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { css, gradient } from "../colour.js";
import { h, tick } from "../dom.js";
import { heading, integer, number, scaleFor } from "../format.js";
import { labelName } from "../data/value.js";
import { labelColour } from "./layer.js";

const kMostLabels = 14;

/** The legends of some layers; those that are coloured alike share one. */
export function legendsOf(layers, changed) {
  const groups = new Map();
  for (const layer of layers) {
    const key = layer.isNumeric()
      ? `${layer.key} ${layer.column?.unit} ${layer.range} ${layer.map}`
      : layer;
    groups.set(key, [...(groups.get(key) ?? []), layer]);
  }
  return [...groups.values()]
    .map((group) => legendOf(group[0], changed, group.map((layer) => layer.value.id).join(", ")))
    .filter(Boolean);
}

/** What the colours of a layer mean; null where there is only one. `changed()` after a label is hidden. */
export function legendOf(layer, changed, title = layer.value.id) {
  if (layer.key === "plain") return null;
  if (layer.isNumeric()) return numberLegend(layer, title);
  return labelLegend(layer, title, changed);
}

function numberLegend(layer, title) {
  const unit = layer.column ? layer.column.unit : "m";
  const [lo, hi] = layer.range;
  const scale = scaleFor(unit, Math.max(Math.abs(lo), Math.abs(hi)));
  const name = layer.column ? layer.column.name : "height";
  const full = layer.column ? layer.fullRange() : layer.range;
  const beyond = { 0: full[0] < lo ? "\u2264\u2009" : "", 1: full[1] > hi ? "\u2265\u2009" : "" };
  const ticks = [0, 0.25, 0.5, 0.75, 1].map((t) =>
    h("span", {}, (beyond[t] ?? "") + number((lo + t * (hi - lo)) * scale.factor, 3)),
  );
  return h(
    "figure",
    { class: "legend" },
    h("figcaption", {}, h("b", {}, heading(name, scale.unit)), " ", h("small", {}, title)),
    h("div", { class: "bar", style: { background: gradient(layer.map) } }),
    h("div", { class: "ticks" }, ticks),
  );
}

function labelLegend(layer, title, changed) {
  const labels = layer.value.labels(layer.column);
  const rows = labels.slice(0, kMostLabels).map(({ label, count }, i) => {
    const name = labelName(layer.column, label);
    const entry = tick(
      name,
      !layer.hidden.has(label),
      (shown) => {
        layer.toggleLabel(label, shown);
        changed();
      },
      { "aria-label": `show ${layer.column.name} ${name}` },
    );
    entry.prepend(h("i", { style: { background: css(labelColour(layer.column, labels, i)) } }));
    return h("li", {}, entry, h("small", {}, integer(count)));
  });
  return h(
    "figure",
    { class: "legend" },
    h("figcaption", {}, h("b", {}, layer.column.name), " ", h("small", {}, title)),
    h("ul", {}, rows),
    labels.length > kMostLabels && h("small", {}, `and ${labels.length - kMostLabels} more`),
  );
}
