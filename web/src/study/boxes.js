// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { logAxis } from "../plots/axis.js";

/** A box a variant: median, quartiles and, where the page has them, all repeats as dots. */
export function boxes(study, { measure, log }, variants) {
  const names = variants.map((variant) => study.label(variant));
  return {
    data: variants.map((variant, i) => {
      const shown = (value) => study.shown(measure, value);
      const values = study.values(variant, measure).map(shown);
      const { median, q1, q3 } = variant.summary[measure];
      const spread = values.length
        ? {
            x: values,
            y: values.map(() => i),
            boxpoints: "all",
            jitter: 0.5,
            pointpos: 0,
            quartilemethod: "linear",
          }
        : { y: [i], median: [shown(median)], q1: [shown(q1)], q3: [shown(q3)] };
      return {
        type: "box",
        orientation: "h",
        name: names[i],
        ...spread,
        marker: { color: study.colour(variant), size: 4, opacity: 0.65 },
        line: { width: 1.4, color: study.colour(variant) },
        hovertemplate: `${variant.id}: %{x:.4g} ${study.scales.get(measure).unit}<extra></extra>`,
        hoveron: values.length ? "points" : "boxes",
      };
    }),
    layout: {
      xaxis: {
        title: study.titled(measure),
        ...(log &&
          logAxis(
            variants.flatMap(({ summary }) =>
              [summary[measure].q1, summary[measure].q3].map((value) =>
                study.shown(measure, value),
              ),
            ),
          )),
      },
      yaxis: {
        tickvals: names.map((_, i) => i),
        ticktext: names,
        autorange: "reversed",
        ticks: "",
        zeroline: false,
      },
      showlegend: false,
      boxgap: 0.35,
    },
  };
}
