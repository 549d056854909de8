// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Views of several variants beside each other, moved together, in the same colours.
import { choice, h, tick } from "../dom.js";
import { middleOf } from "../view3d/explorer.js";
import { broadside } from "../view3d/broadside.js";
import { withGraphics } from "../view3d/graphics.js";
import { keyHelp } from "../view3d/keys.js";
import { Layer } from "../view3d/layer.js";
import { legendOf } from "../view3d/legend.js";
import { View } from "../view3d/view.js";

const kMostPanes = 6;
const kFewPanes = 4;

export function sideBySide(values, study) {
  if (values.length === 0) return null;
  const variants = study.variants.filter((variant) =>
    values.some((value) => value.variant === variant.id),
  );
  return withGraphics(() => {
    const sides = new SideBySide(values, study, variants);
    window.velum = { panes: sides.panes.map((pane) => pane.view) }; // for tests and the curious
    return sides.element;
  });
}

/** The best variant of each alternative; where those are few, the next ones too. */
function firstOf(variants, study) {
  const [measure] = study.names;
  const sign = measure && study.better(measure) === "higher" ? -1 : 1;
  const mean = (variant) => variant.summary?.[measure]?.mean;
  const best = measure
    ? [...variants].sort(
        (a, b) => sign * ((mean(a) ?? sign * Infinity) - (mean(b) ?? sign * Infinity)) || 0,
      )
    : variants;
  const taken = new Map();
  const rank = new Map(
    best.map((variant) => {
      const key = variant.axes[study.telling[0]?.name];
      taken.set(key, (taken.get(key) ?? 0) + 1);
      return [variant, taken.get(key)];
    }),
  );
  const rounds = [...best].sort((a, b) => rank.get(a) - rank.get(b));
  const count = Math.min(kMostPanes, Math.max(kFewPanes, taken.size), variants.length);
  return rounds.slice(0, count).sort((a, b) => variants.indexOf(a) - variants.indexOf(b));
}

class SideBySide {
  constructor(values, study, variants) {
    this.values = values;
    this.study = study;
    this.base = middleOf(values);
    this.linked = true;
    this.outputs = [...new Set(values.map((value) => `${value.node}.${value.output}`))];
    this.output =
      this.outputs.find((name) =>
        values.some((value) => value.isMesh() && `${value.node}.${value.output}` === name),
      ) ?? this.outputs[0];
    this.colouring = "height";
    this.variants = variants;
    this.panes = firstOf(variants, study).map((variant) => new Pane(this, variant));
    this.colours = h("span", {});
    this.legend = h("div", { class: "shared-legend" });
    this.element = h(
      "div",
      {},
      this.#tools(),
      h(
        "div",
        { class: "panes", "data-count": this.panes.length },
        this.panes.map((pane) => pane.element),
      ),
      this.legend,
      h("p", { class: "hint keys" }, keyHelp),
    );
    this.refresh();
    this.panes[0]?.view.fit(broadside(this.panes.map((pane) => pane.layer?.value).filter(Boolean)));
  }

  #tools() {
    return h(
      "div",
      { class: "filters" },
      choice(
        "value",
        this.outputs.map((name) => [name, name]),
        this.output,
        (name) => {
          this.output = name;
          this.refresh();
        },
      ),
      this.colours,
      tick("cameras linked", true, (linked) => {
        this.linked = linked;
      }),
      tick("edges", false, (shown) => {
        this.edges = shown;
        this.panes.forEach((pane) => {
          pane.layer?.setEdges(shown && pane.layer.value.isMesh());
          pane.view.draw();
        });
      }),
    );
  }

  valueOf(variant) {
    return this.values.find(
      (value) => value.variant === variant && `${value.node}.${value.output}` === this.output,
    );
  }

  refresh() {
    for (const pane of this.panes) pane.load();
    const keys = new Map(this.panes.flatMap((pane) => pane.layer?.colourings() ?? []));
    if (!keys.has(this.colouring)) this.colouring = "height";
    this.colours.replaceChildren(
      choice("colour", [...keys], this.colouring, (key) => {
        this.colouring = key;
        this.recolour();
      }),
    );
    this.recolour();
  }

  /** The same colours for the same numbers in all panes. */
  recolour() {
    const layers = this.panes.map((pane) => pane.layer).filter(Boolean);
    for (const layer of layers)
      layer.colourBy(
        layer.colourings().some(([key]) => key === this.colouring) ? this.colouring : "plain",
      );
    const numeric = layers.filter((layer) => layer.isNumeric());
    const lo = Math.min(...numeric.map((layer) => layer.goodRange()[0]));
    const hi = Math.max(...numeric.map((layer) => layer.goodRange()[1]));
    for (const layer of numeric) layer.setRange(lo, hi);
    const first = numeric[0];
    this.legend.replaceChildren(
      ...(first ? [legendOf(first, () => {}, `${this.output}, all views`)] : []),
    );
    for (const pane of this.panes) pane.refresh();
  }

  moved(source, pose) {
    if (!this.linked) return;
    for (const pane of this.panes) if (pane !== source) pane.view.follow(pose);
  }
}

class Pane {
  constructor(sides, variant) {
    this.sides = sides;
    this.variant = variant.id;
    this.view = new View(sides.base, `3-D view of variant ${variant.id}. ${keyHelp}`);
    this.view.on("camera", (pose) => sides.moved(this, pose));
    this.legends = h("div", { class: "legends" });
    this.missing = h("p", { class: "missing" });
    this.view.element.append(this.legends, this.missing);
    const label = (one) => `${one.id}: ${sides.study.label(one)}`;
    this.element = h(
      "figure",
      { class: "pane" },
      h(
        "header",
        {},
        h(
          "select",
          {
            "aria-label": "variant to show",
            onchange: (event) => {
              this.variant = event.target.value;
              sides.refresh();
            },
          },
          sides.variants.map((one) =>
            h("option", { value: one.id, selected: one.id === variant.id }, label(one)),
          ),
        ),
      ),
      this.view.element,
    );
  }

  load() {
    if (this.layer) this.view.remove(this.layer);
    this.layer = null;
    const value = this.sides.valueOf(this.variant);
    this.missing.textContent = value ? "" : `This variant has no ${this.sides.output}.`;
    if (!value) return;
    this.layer = new Layer(value, this.sides.base, 0);
    if (this.sides.edges && value.isMesh()) this.layer.setEdges(true);
    this.view.add(this.layer);
    this.view.layersChanged();
  }

  refresh() {
    this.legends.replaceChildren(
      ...[
        this.layer &&
          !this.layer.isNumeric() &&
          legendOf(this.layer, () => this.view.draw(), this.sides.output),
      ].filter(Boolean),
    );
    this.view.draw();
  }
}
