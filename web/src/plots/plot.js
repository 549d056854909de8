// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import Plotly from "plotly.js-cartesian-dist-min";
import { h } from "../dom.js";
import { isPrinting, layoutFor, onTheme } from "./theme.js";

const kConfig = {
  displaylogo: false,
  responsive: true,
  displayModeBar: "hover",
  modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"],
  showSendToCloud: false,
  showEditInChartStudio: false,
};

const all = new Set();
const seen = new IntersectionObserver(
  (entries) => {
    for (const entry of entries) if (entry.isIntersecting) entry.target.plot?.draw();
  },
  { rootMargin: "300px" },
);

/**
 * A plot that is drawn when it comes into sight. `make()` gives { data, layout }; it is asked again when
 * the colours change. `label` says in words what it shows.
 */
export class Plot {
  constructor(label, make, height = 300) {
    this.make = make;
    this.element = h("div", {
      class: "plot",
      role: "img",
      "aria-label": label,
      style: { height: `${height}px` },
    });
    this.element.plot = this;
    all.add(this);
    seen.observe(this.element);
  }

  draw() {
    if (this.drawn) return;
    this.drawn = true;
    const { data, layout } = this.make();
    Plotly.newPlot(this.element, data, layoutFor(layout), kConfig);
  }

  /** After a change of what is to be shown. */
  update(label) {
    if (label) this.element.setAttribute("aria-label", label);
    if (!this.drawn) return;
    const { data, layout } = this.make();
    Plotly.react(this.element, data, layoutFor(layout), kConfig);
  }

  setHeight(height) {
    this.element.style.height = `${height}px`;
  }
}

/** Draws all that has not been in sight yet, for paper. */
function drawAll() {
  for (const plot of all) plot.draw();
}

onTheme(() => {
  if (isPrinting()) drawAll();
  for (const plot of all) {
    plot.update();
    if (plot.drawn) Plotly.Plots.resize(plot.element);
  }
});
