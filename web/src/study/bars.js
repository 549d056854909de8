// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { logAxis } from "../plots/axis.js";
import { ink } from "../plots/theme.js";

/** Horizontal bars of the means; whiskers are the 95 % intervals. */
export function bars(study, { measure, log }, variants) {
  const shown = (value) => study.shown(measure, value);
  const scale = study.scales.get(measure);
  const names = variants.map((variant) => study.label(variant));
  return {
    data: [
      {
        type: "bar",
        orientation: "h",
        y: names.map((_, i) => i),
        x: variants.map((variant) => shown(variant.summary[measure].mean)),
        marker: { color: variants.map((variant) => study.colour(variant)), opacity: 0.85 },
        error_x: {
          type: "data",
          symmetric: false,
          thickness: 1.4,
          width: 4,
          color: ink(),
          array: variants.map(({ summary }) =>
            shown(summary[measure].ci95[1] - summary[measure].mean),
          ),
          arrayminus: variants.map(({ summary }) =>
            shown(summary[measure].mean - summary[measure].ci95[0]),
          ),
        },
        customdata: variants.map((variant, i) => [
          variant.id,
          names[i],
          variant.summary[measure].count,
        ]),
        hovertemplate: `%{customdata[0]}: %{customdata[1]}<br>%{x:.4g} ${scale.unit}, %{customdata[2]} repeats<extra></extra>`,
      },
    ],
    layout: {
      xaxis: {
        title: study.titled(measure),
        ...(log && logAxis(variants.map(({ summary }) => shown(summary[measure].mean)))),
        rangemode: "tozero",
      },
      yaxis: {
        tickvals: names.map((_, i) => i),
        ticktext: names,
        autorange: "reversed",
        ticks: "",
        zeroline: false,
      },
      bargap: 0.3,
    },
  };
}
