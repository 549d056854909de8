// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Any two measures against each other, with the Pareto front.
import { choice, h, tick } from "../dom.js";
import { logAxis } from "../plots/axis.js";
import { Plot } from "../plots/plot.js";
import { front } from "./pareto.js";

const kMostIntervals = 60; // more would hide the points
const kSymbols = ["circle", "square", "diamond", "triangle-up", "cross", "x", "star", "pentagon"];

export function scatterSection(study) {
  const [x, y] = study.firstPair();
  const state = { x, y, repeats: false, logX: spread(study, x) > 30, logY: spread(study, y) > 30 };
  const said = h("p", { class: "hint", role: "status" });
  const plot = new Plot(`${state.y} over ${state.x}`, () => picture(study, state), 470);
  const set = (key) => (value) => {
    state[key] = value;
    plot.update(`${state.y} over ${state.x}`);
    said.textContent = frontText(study, state);
  };
  said.textContent = frontText(study, state);
  const measures = study.names.map((name) => [name, study.titled(name)]);
  return [
    h(
      "div",
      { class: "filters" },
      choice("across", measures, state.x, set("x"), { id: "scatter-x" }),
      choice("up", measures, state.y, set("y"), { id: "scatter-y" }),
      tick("log across", state.logX, set("logX")),
      tick("log up", state.logY, set("logY")),
      study.hasRuns && study.hasRepeats() && tick("every repeat", false, set("repeats")),
    ),
    h("figure", { class: "card" }, plot.element, said),
  ];
}

function spread(study, name) {
  const means = study.variants
    .map((variant) => variant.summary?.[name]?.mean)
    .filter((mean) => mean > 0);
  return means.length > 1 ? Math.max(...means) / Math.min(...means) : 1;
}

function pointsOf(study, { x, y }) {
  return study.variants
    .filter(({ summary }) => summary?.[x]?.count && summary?.[y]?.count)
    .map((variant) => ({
      variant,
      x: study.shown(x, variant.summary[x].mean),
      y: study.shown(y, variant.summary[y].mean),
    }));
}

function frontText(study, state) {
  const best = front(pointsOf(study, state), study.better(state.x), study.better(state.y));
  if (!best) return "No front: one of these measures has no better direction.";
  return `Pareto front (no other variant is better in both): ${best.map(({ variant }) => study.label(variant)).join("; ")}.`;
}

function picture(study, state) {
  const points = pointsOf(study, state);
  const best = front(points, study.better(state.x), study.better(state.y));
  const groups = new Map();
  for (const point of points) {
    const key = study.label(point.variant, study.telling.slice(0, 1));
    groups.set(key, [...(groups.get(key) ?? []), point]);
  }
  const data = [...groups].map(([name, group]) =>
    means(study, state, name, group, points.length <= kMostIntervals),
  );
  if (state.repeats) data.unshift(repeats(study, state));
  if (best?.length > 1) data.unshift(staircase(best, study, state));
  return {
    data,
    layout: {
      xaxis: {
        title: study.titled(state.x),
        ...(state.logX && logAxis(points.map((point) => point.x))),
      },
      yaxis: {
        title: study.titled(state.y),
        ...(state.logY && logAxis(points.map((point) => point.y))),
      },
      hovermode: "closest",
    },
  };
}

function means(study, { x, y }, name, group, intervals) {
  const second = study.telling[1];
  const interval = (measure) => ({
    type: "data",
    symmetric: false,
    thickness: 1,
    width: 0,
    array: group.map(({ variant }) =>
      study.shown(measure, variant.summary[measure].ci95[1] - variant.summary[measure].mean),
    ),
    arrayminus: group.map(({ variant }) =>
      study.shown(measure, variant.summary[measure].mean - variant.summary[measure].ci95[0]),
    ),
  });
  return {
    x: group.map((point) => point.x),
    y: group.map((point) => point.y),
    mode: "markers",
    name,
    marker: {
      color: study.colour(group[0].variant),
      size: intervals ? 11 : 7,
      symbol: group.map(
        ({ variant }) =>
          kSymbols[second ? second.values.indexOf(variant.axes[second.name]) % kSymbols.length : 0],
      ),
      line: { width: 1, color: "rgba(128,128,128,0.5)" },
    },
    ...(intervals && { error_x: interval(x), error_y: interval(y) }),
    text: group.map(({ variant }) => `${variant.id}: ${study.label(variant)}`),
    hovertemplate: `%{text}<br>%{x:.4g} ${study.scales.get(x).unit}, %{y:.4g} ${study.scales.get(y).unit}<extra></extra>`,
  };
}

function repeats(study, { x, y }) {
  const runs = study.variants.flatMap((variant) =>
    variant.runs
      .filter(
        (run) =>
          run.status === "ok" &&
          typeof run.measures[x] === "number" &&
          typeof run.measures[y] === "number",
      )
      .map((run) => ({ variant, run })),
  );
  return {
    x: runs.map(({ run }) => study.shown(x, run.measures[x])),
    y: runs.map(({ run }) => study.shown(y, run.measures[y])),
    mode: "markers",
    name: "repeats",
    showlegend: false,
    marker: { size: 4, opacity: 0.35, color: runs.map(({ variant }) => study.colour(variant)) },
    hoverinfo: "skip",
  };
}

/** Steps between the points of the front: what can be had for less of one is more of the other. */
function staircase(best, study, { x }) {
  const shape = study.better(x) === "lower" ? "hv" : "vh";
  return {
    x: best.map((point) => point.x),
    y: best.map((point) => point.y),
    mode: "lines",
    name: "Pareto front",
    line: { color: "#7f8c99", width: 1.6, dash: "dash", shape },
    hoverinfo: "skip",
  };
}
