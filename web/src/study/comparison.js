// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// One measure over all variants: bars with intervals, curves over a parameter, boxes of the repeats.
import { choice, h, tick } from "../dom.js";
import { Plot } from "../plots/plot.js";
import { boxes } from "./boxes.js";
import { bars } from "./bars.js";
import { numericAxis } from "./model.js";
import { sweep } from "./sweep.js";

const kMost = 40;

export function comparisonSection(study) {
  const state = {
    measure: study.names[0],
    axis: sweepable(study)[0]?.name,
    log: false,
    order: "study",
  };
  const parts = [
    {
      title: "Mean with its 95 % interval",
      make: () => bars(study, state, chosen()),
      height: () => 90 + 24 * chosen().length,
    },
    study.hasRepeats() && {
      title: "All repeats",
      make: () => boxes(study, state, chosen()),
      height: () => 90 + 24 * chosen().length,
    },
    state.axis !== undefined && {
      title: "Over a parameter",
      make: () => sweep(study, state),
      height: () => 400,
      axis: true,
    },
  ].filter(Boolean);
  const chosen = () => selection(study, state);
  const plots = parts.map(
    (part) => new Plot(`${part.title}: ${state.measure}`, part.make, part.height()),
  );
  const update = () =>
    plots.forEach((plot, i) => {
      plot.setHeight(parts[i].height());
      plot.update(`${parts[i].title}: ${state.measure}`);
    });
  const set = (key) => (value) => {
    state[key] = value;
    update();
  };
  const left = study.variants.length - chosen().length;
  return [
    h(
      "div",
      { class: "filters" },
      choice(
        "measure",
        study.names.map((name) => [name, study.titled(name)]),
        state.measure,
        set("measure"),
        { id: "measure" },
      ),
      choice(
        "order",
        [
          ["study", "as in the study"],
          ["best", "best first"],
        ],
        "study",
        set("order"),
      ),
      sweepable(study).length > 1 &&
        choice(
          "over",
          sweepable(study).map((axis) => [axis.name, axis.name]),
          state.axis,
          set("axis"),
        ),
      tick("logarithmic", false, set("log")),
    ),
    h(
      "div",
      { class: "multiples wide" },
      parts.map((part, i) =>
        h(
          "figure",
          { class: "card" },
          h("figcaption", {}, h("b", {}, part.title)),
          plots[i].element,
        ),
      ),
    ),
    left > 0 &&
      h(
        "p",
        { class: "hint" },
        `Bars and boxes show ${chosen().length} of ${study.variants.length} variants: those that failed are in the table, of more than ${kMost} the best are shown.`,
      ),
  ];
}

/** Axes over which curves make sense. */
const sweepable = (study) => study.telling.filter((axis) => numericAxis(axis));

/** Variants that have the measure, in order, not too many. */
function selection(study, { measure, order }) {
  const sign = study.better(measure) === "higher" ? -1 : 1;
  const having = study.variants.filter((variant) => variant.summary?.[measure]?.count > 0);
  const byMean = (a, b) => sign * (a.summary[measure].mean - b.summary[measure].mean);
  if (order === "best") return [...having].sort(byMean).slice(0, kMost);
  if (having.length <= kMost) return having;
  const best = new Set([...having].sort(byMean).slice(0, kMost));
  return having.filter((variant) => best.has(variant));
}
