// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { categoryCss } from "../colour.js";
import { heading, number } from "../format.js";
import { logAxis } from "../plots/axis.js";
import { numericAxis } from "./model.js";

const kMostCurves = 24;
const kMostTicks = 8;
const kDashes = ["solid", "dot", "dash", "dashdot", "longdash"];

/**
 * The mean over a parameter's values: a curve for each combination of the other axes, with its band.
 * Where these are too many, the last axes are averaged over, without a band.
 */
export function sweep(study, { measure, axis: name, log }) {
  const axis = study.axes.find((one) => one.name === name);
  const numeric = numericAxis(axis);
  const others = study.telling.filter((one) => one !== axis);
  const many = (axes) => axes.reduce((product, one) => product * one.values.length, 1);
  const averaged = [];
  while (others.length && many(others) > kMostCurves) averaged.unshift(others.pop());
  const curves = new Map();
  for (const variant of study.variants) {
    if (!variant.summary?.[measure]?.count) continue;
    const key = study.label(variant, others.length || averaged.length ? others : study.telling);
    if (!curves.has(key)) curves.set(key, []);
    curves.get(key).push(variant);
  }
  const values = [...numeric.at.values()];
  const geometric =
    values.length > 2 && Math.min(...values) > 0 && Math.max(...values) / Math.min(...values) > 8;
  const first = others[0];
  const data = [...curves].flatMap(([label, variants], i) => {
    const colour = categoryCss(
      first ? Math.max(0, first.values.indexOf(variants[0].axes[first.name])) : 0,
    );
    const dash =
      kDashes[
        others.length > 1
          ? Math.max(0, others[1].values.indexOf(variants[0].axes[others[1].name])) % kDashes.length
          : 0
      ];
    const text = averaged.length
      ? `${others.length ? label : "mean"}, over all ${averaged.map((one) => one.name).join(", ")}`
      : label;
    return curve(
      study,
      measure,
      text,
      pointsOf(study, measure, variants, ({ axes }) => numeric.at.get(axes[name])),
      colour,
      dash,
      i,
    );
  });
  return {
    data,
    layout: {
      xaxis: {
        title: heading(name, numeric.unit),
        ...(geometric &&
          (values.length > kMostTicks
            ? logAxis(values)
            : {
                type: "log",
                tickmode: "array",
                tickvals: values,
                ticktext: values.map((x) => number(x, 4)),
              })),
      },
      yaxis: {
        title: study.titled(measure),
        ...(log &&
          logAxis(
            [...curves.values()]
              .flat()
              .map(({ summary }) => study.shown(measure, summary[measure].mean)),
          )),
      },
      showlegend: curves.size > 1,
    },
  };
}

/** One point a value of the axis; an interval only where one variant stands behind it. */
function pointsOf(study, measure, variants, valueOf) {
  const places = new Map();
  for (const variant of variants) {
    const x = valueOf(variant);
    if (!places.has(x)) places.set(x, []);
    places.get(x).push(variant.summary[measure]);
  }
  return [...places]
    .sort((a, b) => a[0] - b[0])
    .map(([x, summaries]) => {
      const mean = study.shown(
        measure,
        summaries.reduce((sum, summary) => sum + summary.mean, 0) / summaries.length,
      );
      const [low, high] =
        summaries.length === 1
          ? summaries[0].ci95.map((value) => study.shown(measure, value))
          : [mean, mean];
      return { x, mean, low, high };
    });
}

function curve(study, measure, label, points, colour, dash, i) {
  const x = points.map((point) => point.x);
  const low = points.map((point) => point.low);
  const high = points.map((point) => point.high);
  const band = colour.replace("rgb(", "rgba(").replace(")", ", 0.15)");
  return [
    {
      x: [...x, ...[...x].reverse()],
      y: [...high, ...low.reverse()],
      fill: "toself",
      fillcolor: band,
      line: { width: 0 },
      mode: "lines",
      hoverinfo: "skip",
      showlegend: false,
      legendgroup: String(i),
    },
    {
      x,
      y: points.map((point) => point.mean),
      name: label,
      mode: "lines+markers",
      line: { color: colour, width: 2, dash },
      marker: { size: 7 },
      legendgroup: String(i),
      hovertemplate: `${label} %{x}: %{y:.4g} ${study.scales.get(measure).unit}<extra></extra>`,
    },
  ];
}
