// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// The history of a registration: error, steps and the path of the source's barycentre.
import { categoryCss } from "../colour.js";
import { h } from "../dom.js";
import { heading, quantity, scaleFor } from "../format.js";
import { logAxis } from "./axis.js";
import { Plot } from "./plot.js";

const columnOf = (rows, name) => {
  const at = rows.columns.findIndex((column) => column.name === name);
  return at < 0
    ? null
    : { unit: rows.columns[at].unit, values: rows.rows.map((row) => row[at] ?? NaN) };
};

const isHistory = (value) => {
  const names = value.rows?.columns.map((column) => column.name) ?? [];
  return names.includes("iteration") && names.includes("error") && value.rows.rows.length > 0;
};

/** One history a node: its table, else what its transform carries. */
export function historiesOf(values) {
  const found = new Map();
  for (const value of values.filter(isHistory))
    if (!found.has(value.node) || value.type === "table") found.set(value.node, value);
  return [...found.values()];
}

/** Figures of one history table. */
export function historyFigures(value) {
  const { rows } = value;
  const iteration = columnOf(rows, "iteration").values;
  const error = columnOf(rows, "error");
  const figures = [convergence(value, iteration, error)];
  const steps = ["rotation", "translation"]
    .map((name) => ({ name, column: columnOf(rows, name) }))
    .filter(({ column }) => column);
  if (steps.length) figures.push(motion(value, iteration, steps));
  const path = ["x", "y", "z"].map((name) => columnOf(rows, name));
  if (path.every(Boolean)) figures.push(...barycentre(value, iteration, path));
  return figures;
}

const largest = (values) => Math.max(0, ...values.filter(Number.isFinite).map(Math.abs));

const card = (title, value, plot, hint) =>
  h(
    "figure",
    { class: "card" },
    h("figcaption", {}, h("b", {}, title), ` ${value.id}`),
    plot.element,
    hint && h("p", { class: "hint" }, hint),
  );

function convergence(value, iteration, error) {
  // Mean squared errors are shown as root mean squares: metres are what people think in.
  const squared = error.unit === "m^2";
  const values = squared ? error.values.map(Math.sqrt) : error.values;
  const unit = squared ? "m" : error.unit;
  const scale = scaleFor(unit, largest(values));
  const name = squared ? "root mean squared error" : "error";
  const label = `${name} of ${value.node} from ${quantity(values[0], unit)} to ${quantity(values.at(-1), unit)} in ${iteration.length} iterations`;
  const plot = new Plot(
    label,
    () => ({
      data: [
        {
          x: iteration,
          y: values.map((y) => y * scale.factor),
          mode: "lines+markers",
          line: { color: categoryCss(0), width: 2 },
          marker: { size: 6 },
          hovertemplate: `%{x}: %{y:.5g} ${scale.unit}<extra></extra>`,
        },
      ],
      layout: {
        xaxis: { title: "iteration", dtick: iteration.length < 12 ? 1 : undefined },
        yaxis: {
          title: heading(name, scale.unit),
          ...logAxis(values.map((y) => y * scale.factor)),
        },
      },
    }),
    260,
  );
  return card(
    "Convergence",
    value,
    plot,
    `${quantity(values[0], unit)} to ${quantity(values.at(-1), unit)} in ${iteration.length} iterations.`,
  );
}

function motion(value, iteration, steps) {
  const plot = new Plot(
    `rotation and translation of each step of ${value.node}`,
    () => {
      const scales = steps.map(({ column }) => scaleFor(column.unit, largest(column.values)));
      return {
        data: steps.map(({ name, column }, i) => ({
          x: iteration,
          y: column.values.map((y) => Math.abs(y * scales[i].factor)),
          name: heading(name, scales[i].unit),
          mode: "lines+markers",
          yaxis: i ? "y2" : "y",
          line: { color: categoryCss(i ? 1 : 2), width: 2, dash: i ? "dot" : "solid" },
          marker: { size: 6, symbol: i ? "square" : "circle" },
        })),
        layout: {
          xaxis: { title: "iteration", dtick: iteration.length < 12 ? 1 : undefined },
          yaxis: {
            title: heading(steps[0].name, scales[0].unit),
            ...logAxis(steps[0].column.values.map((y) => Math.abs(y * scales[0].factor))),
          },
          ...(steps[1] && {
            yaxis2: {
              title: heading(steps[1].name, scales[1].unit),
              overlaying: "y",
              side: "right",
              showgrid: false,
              ...logAxis(steps[1].column.values.map((y) => Math.abs(y * scales[1].factor))),
            },
          }),
          margin: { l: 56, r: 60, t: 30, b: 44 },
        },
      };
    },
    260,
  );
  return card("Motion of each step", value, plot);
}

function barycentre(value, iteration, path) {
  const size = Math.max(...path.map(({ values }) => Math.max(...values) - Math.min(...values)));
  const scale = scaleFor("m", size);
  const start = path.map(({ values }) => values[0]);
  const moved = Math.hypot(...path.map(({ values }) => values.at(-1) - values[0]));
  const off = path.map(({ values }, axis) => values.map((x) => (x - start[axis]) * scale.factor));
  const plot = new Plot(
    `path of the barycentre of ${value.node}: ${quantity(moved, "m")} from first to last`,
    () => ({
      data: [
        [0, 1, "from above (x, y)", 0],
        [0, 2, "from the side (x, z)", 3],
      ].map(([a, b, name, colour]) => ({
        x: off[a],
        y: off[b],
        name,
        text: iteration.map(String),
        mode: "lines+markers",
        line: { color: categoryCss(colour), width: 2 },
        marker: {
          size: iteration.map((_, i) => (i === 0 || i === iteration.length - 1 ? 10 : 5)),
          symbol: iteration.map((_, i) => (i === 0 ? "circle-open" : "circle")),
        },
        hovertemplate: `iteration %{text}<br>%{x:.4g}, %{y:.4g} ${scale.unit}<extra></extra>`,
      })),
      layout: {
        xaxis: { title: heading("x", scale.unit) },
        yaxis: { title: heading("y, z", scale.unit), scaleanchor: "x" },
        margin: { l: 56, r: 16, t: 30, b: 44 },
      },
    }),
    260,
  );
  return [
    card(
      "Path of the barycentre",
      value,
      plot,
      `From its first place (open circle), ${quantity(moved, "m")} in all.`,
    ),
  ];
}
