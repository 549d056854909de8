// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { categoryCss } from "../colour.js";
import { h } from "../dom.js";
import { heading, integer, quantity, scaleFor } from "../format.js";
import { Plot } from "./plot.js";

// What is asked for first; other columns follow under a fold.
const kFirst = [/deviation/, /displacement/, /^distance/, /angle/, /edge.ratio/];
const importance = (name) => {
  const at = kFirst.findIndex((pattern) => pattern.test(name));
  return at < 0 ? kFirst.length : at;
};

/** All histograms of a run, or null: the telling ones, and the others folded. */
export function histogramSection(histograms) {
  const groups = paired(histograms);
  if (groups.length === 0) return null;
  groups.sort((a, b) => importance(a[0].name) - importance(b[0].name));
  const telling = groups.filter((group) => importance(group[0].name) < kFirst.length);
  const others = groups.filter((group) => importance(group[0].name) === kFirst.length);
  return [
    telling.length > 0 && h("div", { class: "multiples" }, telling.map(figure)),
    others.length > 0 &&
      h(
        "details",
        { open: telling.length === 0 },
        h("summary", {}, `${others.length} more columns`),
        h("div", { class: "multiples" }, others.map(figure)),
      ),
  ];
}

/** "distance before" and "distance after" of one value belong into one picture. */
function paired(histograms) {
  const groups = new Map();
  for (const histogram of histograms) {
    if (!histogram.counts?.length) continue;
    const key = `${histogram.value} ${histogram.name.replace(/ (before|after)$/, "")}`;
    groups.set(key, [...(groups.get(key) ?? []), histogram]);
  }
  return [...groups.values()];
}

function figure(group) {
  const size = Math.max(...group.flatMap(({ lo, hi }) => [Math.abs(lo), Math.abs(hi)]));
  const scale = scaleFor(group[0].unit, size);
  const name = group.length > 1 ? group[0].name.replace(/ (before|after)$/, "") : group[0].name;
  const words = group.map(
    (one) =>
      `${one.name} of ${one.value}: ${integer(total(one))} values from ${quantity(one.lo, one.unit)} to ${quantity(one.hi, one.unit)}, median near ${quantity(median(one), one.unit)}`,
  );
  const plot = new Plot(
    words.join("; "),
    () => ({
      data: group.map((one, i) => trace(one, i, scale, group.length > 1)),
      layout: {
        xaxis: { title: heading(name, scale.unit) },
        yaxis: { title: "count", rangemode: "tozero" },
        barmode: "overlay",
        bargap: 0,
        showlegend: group.length > 1,
        margin: { l: 56, r: 8, t: group.length > 1 ? 28 : 8, b: 44 },
      },
    }),
    230,
  );
  return h(
    "figure",
    { class: "card" },
    h("figcaption", {}, h("b", {}, name), ` ${group[0].value}`),
    plot.element,
    h(
      "p",
      { class: "hint" },
      group.map((one) =>
        h(
          "span",
          {},
          `${group.length > 1 ? `${one.name}: ` : ""}median \u2248 ${quantity(median(one), one.unit, 3)}, 95 % below ${quantity(quantile(one, 0.95), one.unit, 3)}${tails(one)}. `,
        ),
      ),
    ),
  );
}

function trace(histogram, i, scale, many) {
  const { lo, hi, counts } = histogram;
  const step = ((hi - lo) / counts.length) * scale.factor;
  return {
    type: "bar",
    name: histogram.name,
    x: counts.map((_, bin) => lo * scale.factor + (bin + 0.5) * step),
    y: counts,
    width: step || 1,
    marker: {
      color: categoryCss(many ? 1 - i : 0),
      opacity: many ? 0.65 : 0.9,
      line: { width: 0 },
    },
    hovertemplate: `%{x:.4g} ${scale.unit}: %{y}<extra></extra>`,
  };
}

/** Of all values, also those beyond the range that is drawn. */
const total = ({ counts, below = 0, above = 0 }) =>
  below + above + counts.reduce((sum, count) => sum + count, 0);
const median = (histogram) => quantile(histogram, 0.5);

function tails({ below = 0, above = 0 }) {
  if (below + above === 0) return "";
  return `; ${[below && `${integer(below)} lie below`, above && `${integer(above)} above`].filter(Boolean).join(", ")} what is drawn`;
}

/** The quantile, straight within its bin. */
export function quantile(histogram, share) {
  const { lo, hi, counts } = histogram;
  const wanted = share * total(histogram);
  let below = histogram.below ?? 0;
  for (let bin = 0; bin < counts.length; ++bin) {
    if (below + counts[bin] >= wanted && counts[bin] > 0)
      return lo + ((hi - lo) * (bin + (wanted - below) / counts[bin])) / counts.length;
    below += counts[bin];
  }
  return hi;
}
