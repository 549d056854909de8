// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { categoryCss } from "../colour.js";
import { heading, number } from "../format.js";
import { logAxis } from "../plots/axis.js";
import { numericAxis } from "./model.js";

const kDashes = ["solid", "dot", "dash", "dashdot", "longdash"];

/** The mean over a parameter's values: a curve for each combination of the other axes, with its band. */
export function sweep(study, { measure, axis: name, log }) {
  const axis = study.axes.find((one) => one.name === name);
  const numeric = numericAxis(axis);
  const others = study.telling.filter((one) => one !== axis);
  const curves = new Map();
  for (const variant of study.variants) {
    if (!variant.summary?.[measure]?.count) continue;
    const key = study.label(variant, others);
    curves.set(key, [...(curves.get(key) ?? []), variant]);
  }
  const values = [...numeric.at.values()];
  const geometric = values.length > 2 && Math.min(...values) > 0 && Math.max(...values) / Math.min(...values) > 8;
  const first = others[0];
  const data = [...curves].flatMap(([label, variants], i) => {
    const colour = categoryCss(first ? Math.max(0, first.values.indexOf(variants[0].axes[first.name])) : 0);
    const dash = kDashes[others.length > 1 ? Math.max(0, others[1].values.indexOf(variants[0].axes[others[1].name])) % kDashes.length : 0];
    return curve(study, measure, label, variants.map((variant) => ({ variant, x: numeric.at.get(variant.axes[name]) })).sort((a, b) => a.x - b.x), colour, dash, i);
  });
  return {
    data,
    layout: {
      xaxis: { title: heading(name, numeric.unit), ...(geometric && { type: "log", tickmode: "array", tickvals: values, ticktext: values.map((x) => number(x, 4)) }) },
      yaxis: { title: study.titled(measure), ...(log && logAxis([...curves.values()].flat().map(({ summary }) => study.shown(measure, summary[measure].mean)))) },
      showlegend: curves.size > 1,
    },
  };
}

function curve(study, measure, label, points, colour, dash, i) {
  const shown = (value) => study.shown(measure, value);
  const x = points.map((point) => point.x);
  const low = points.map(({ variant }) => shown(variant.summary[measure].ci95[0]));
  const high = points.map(({ variant }) => shown(variant.summary[measure].ci95[1]));
  const band = colour.replace("rgb(", "rgba(").replace(")", ", 0.15)");
  return [
    { x: [...x, ...[...x].reverse()], y: [...high, ...low.reverse()], fill: "toself", fillcolor: band, line: { width: 0 }, mode: "lines", hoverinfo: "skip", showlegend: false, legendgroup: String(i) },
    { x, y: points.map(({ variant }) => shown(variant.summary[measure].mean)), name: label, mode: "lines+markers", line: { color: colour, width: 2, dash }, marker: { size: 7 }, legendgroup: String(i), hovertemplate: `${label} %{x}: %{y:.4g} ${study.scales.get(measure).unit}<extra></extra>` },
  ];
}
