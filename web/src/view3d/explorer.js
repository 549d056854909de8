// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A view with its list of values, legends, tools and picks.
import { button, download, h, tick } from "../dom.js";
import { quantity } from "../format.js";
import { broadside } from "./broadside.js";
import { directions, keyHelp } from "./keys.js";
import { Layer } from "./layer.js";
import { legendsOf } from "./legend.js";
import { panelRow } from "./panel.js";
import { Picks } from "./picks.js";
import { Scanners, pathLine } from "./scanners.js";
import { telling } from "./telling.js";
import { View } from "./view.js";

/** The middle of all values, which views have as their origin [m]. */
export function middleOf(values) {
  const lo = [Infinity, Infinity, Infinity];
  const hi = [-Infinity, -Infinity, -Infinity];
  for (const value of values) {
    const [a, b] = value.bounds();
    for (const axis of [0, 1, 2]) {
      lo[axis] = Math.min(lo[axis], a[axis]);
      hi[axis] = Math.max(hi[axis], b[axis]);
    }
  }
  return lo.map((x, axis) => (Number.isFinite(x) ? (x + hi[axis]) / 2 : 0));
}

/** The same colour is the same height in all values, unless a person wants another range. */
function shareHeights(layers) {
  const free = layers.filter((layer) => layer.key === "height" && !layer.chosen);
  const lo = Math.min(...free.map((layer) => layer.fullRange()[0]));
  const hi = Math.max(...free.map((layer) => layer.fullRange()[1]));
  for (const layer of free) layer.setRange(lo, hi);
}

export class Explorer {
  /**
   * `first`: ids of the values that are shown at the start, with the key of their colouring; `paths`:
   * lists of points, such as the way of a barycentre.
   */
  constructor(values, nodes, first, paths = []) {
    this.view = new View(middleOf(values), `3-D view of the run's clouds and meshes. ${keyHelp}`);
    this.picks = new Picks(this.view, nodes);
    this.scanners = new Scanners(this.view);
    this.legends = h("div", { class: "legends" });
    this.scale = h("span", { class: "scale" });
    this.view.grid.onSpacing = (spacing) => {
      this.scale.textContent = `grid ${quantity(spacing, "m")}`;
    };
    this.entries = values.map((value, i) => this.#entry(value, i));
    for (const entry of this.entries)
      if (first.has(entry.value.id)) entry.show(true, first.get(entry.value.id));
    this.view.element.append(
      this.legends,
      this.scale,
      h("span", { class: "cross", "aria-hidden": "true" }),
    );
    this.paths = paths.map((points) => pathLine(this.view, points, 0xd55e00));
    this.element = this.#build();
    this.refresh();
    this.view.fit(
      broadside(this.entries.filter((entry) => entry.layer?.visible).map(({ value }) => value)),
    );
  }

  #entry(value, index) {
    const entry = { value, layer: null, changed: () => this.refresh() };
    entry.show = (visible, colouring) => {
      if (!entry.layer && visible) {
        entry.layer = new Layer(value, this.view.base, index);
        entry.layer.colourBy(colouring ?? telling(value) ?? "plain");
        this.view.add(entry.layer);
      }
      entry.layer?.setVisible(visible);
      this.view.layersChanged();
      this.refresh();
    };
    return entry;
  }

  /** Legends, scanners and the picture after a change. */
  refresh() {
    const visible = this.entries.filter((entry) => entry.layer?.visible);
    shareHeights(visible.map(({ layer }) => layer));
    this.legends.replaceChildren(
      ...legendsOf(
        visible.map(({ layer }) => layer),
        () => this.view.draw(),
      ),
    );
    this.scanners.refresh(visible.map(({ value }) => value));
    this.view.draw();
  }

  #build() {
    const list = h(
      "ul",
      { class: "layers" },
      this.entries.map((entry) => panelRow(entry)),
    );
    return h(
      "div",
      { class: "explorer" },
      h("div", { class: "tools", role: "toolbar", "aria-label": "3-D view" }, this.#tools()),
      h(
        "div",
        { class: "split" },
        h("nav", { class: "panel", "aria-label": "values to show" }, list),
        this.view.element,
      ),
      h("p", { class: "hint keys" }, keyHelp),
      this.picks.element,
    );
  }

  #tools() {
    const { view } = this;
    return [
      button("Show all", () => view.fit()),
      this.scanners.marks.length > 0 &&
        button("With scanners", () => view.fit(null, this.scanners.positions())),
      h("span", { class: "field" }, h("span", {}, "from")),
      Object.entries(directions).map(([name, direction]) =>
        button(name, () => view.fit(direction), {
          class: "small",
          "aria-label": `look from ${name}`,
        }),
      ),
      tick("grid", true, (shown) => {
        view.grid.setVisible(shown);
        view.draw();
      }),
      tick("scanners", true, (shown) => this.scanners.setVisible(shown)),
      this.paths.length > 0 &&
        tick("barycentre path", false, (shown) => {
          for (const line of this.paths) line.visible = shown;
          view.draw();
        }),
      tick("relief", true, (shown) => {
        view.dome.strength = shown ? 60 : 0;
        view.draw();
      }),
      button("Save picture", async () => {
        const bytes = Uint8Array.from(atob(view.picture().split(",")[1]), (c) => c.charCodeAt(0));
        download("velum.png", bytes, "image/png");
      }),
    ];
  }
}
