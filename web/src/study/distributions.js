// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Distributions of a study: all variants in one picture, as shares, so that they can be compared.
import { h } from "../dom.js";
import { heading, scaleFor } from "../format.js";
import { quantile } from "../plots/histograms.js";
import { Plot } from "../plots/plot.js";

const kMain = 0.97; // share of each variant that the picture shows at least; the rest by zooming out
const kDashes = ["solid", "dot", "dash", "dashdot", "longdash"];

/** A picture for each distribution that at least two variants have; null where there is none. */
export function distributionsSection(report, study) {
  const variants = new Map(study.variants.map((variant) => [variant.id, variant]));
  const groups = new Map();
  for (const histogram of report.histograms) {
    const slash = histogram.value.indexOf("/");
    const variant = variants.get(histogram.value.slice(0, slash));
    if (!variant || !histogram.counts?.length) continue;
    const key = `${histogram.name} ${histogram.value.slice(slash + 1)}`;
    groups.set(key, [
      ...(groups.get(key) ?? []),
      { variant, histogram, of: histogram.value.slice(slash + 1) },
    ]);
  }
  const several = [...groups.values()].filter((group) => group.length > 1 && differ(group));
  return several.length
    ? h(
        "div",
        { class: "multiples wide" },
        several.map((group) => figure(group, study)),
      )
    : null;
}

/** What all variants have alike, such as the truth's mesh, tells nothing. */
const differ = (group) =>
  new Set(group.map(({ histogram }) => JSON.stringify(histogram.counts))).size > 1;

function figure(group, study) {
  const [{ histogram, of }] = group;
  const size = Math.max(
    ...group.map((one) =>
      Math.max(Math.abs(one.histogram.lo), Math.abs(quantile(one.histogram, kMain))),
    ),
  );
  const scale = scaleFor(histogram.unit, size);
  // One variant's long tail must not press all others together.
  const range = [
    Math.min(...group.map((one) => one.histogram.lo)),
    Math.max(...group.map((one) => quantile(one.histogram, kMain))),
  ];
  const plot = new Plot(
    `${histogram.name} of ${of} in ${group.length} variants`,
    () => ({
      data: group.map((one) => curve(one, scale, study)),
      layout: {
        xaxis: {
          title: heading(histogram.name, scale.unit),
          range: range.map((x) => x * scale.factor),
        },
        yaxis: { title: `share [% per ${scale.unit || "unit"}]`, rangemode: "tozero" },
        showlegend: false,
      },
    }),
    290,
  );
  return h(
    "figure",
    { class: "card" },
    h("figcaption", {}, h("b", {}, histogram.name), ` ${of}`),
    plot.element,
  );
}

function curve({ variant, histogram }, scale, study) {
  const { lo, hi, counts, below = 0, above = 0 } = histogram;
  const total = counts.reduce((sum, count) => sum + count, below + above) || 1;
  const step = ((hi - lo) / counts.length) * scale.factor || 1;
  const second = study.telling[1];
  return {
    x: counts.map((_, bin) => lo * scale.factor + (bin + 0.5) * step),
    y: counts.map((count) => (100 * count) / total / step),
    mode: "lines",
    name: study.label(variant),
    line: {
      shape: "hvh",
      width: 1.5,
      color: study.colour(variant),
      dash: kDashes[second ? second.values.indexOf(variant.axes[second.name]) % kDashes.length : 0],
    },
    hovertemplate: `${variant.id} ${study.label(variant)}: %{x:.4g} ${scale.unit}<extra></extra>`,
  };
}
