// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// The list of values beside a view: what is shown and how.
import { css, mapNames } from "../colour.js";
import { button, choice, h, newId, tick } from "../dom.js";
import { integer, scaleFor } from "../format.js";

/** A row for a value. `entry` has the value, its layer once shown, and `show(visible)`, `changed()`. */
export function panelRow(entry) {
  const { value } = entry;
  const details = h("div", { class: "how", hidden: !entry.layer?.visible });
  const box = h("input", {
    type: "checkbox",
    id: newId("show"),
    checked: Boolean(entry.layer?.visible),
    onchange: () => {
      entry.show(box.checked);
      refresh();
    },
  });
  const swatch = h("i", { class: "swatch" });
  const refresh = () => {
    box.checked = Boolean(entry.layer?.visible);
    details.hidden = !box.checked;
    if (entry.layer)
      swatch.style.background =
        entry.layer.key === "plain" ? css(entry.layer.plain) : "var(--ramp)";
    if (box.checked && details.childElementCount === 0) details.append(...controls(entry, refresh));
  };
  refresh();
  return h(
    "li",
    { class: "layer" },
    h(
      "div",
      { class: "head" },
      box,
      swatch,
      h(
        "label",
        { for: box.id },
        h("b", {}, breakable(value.node)),
        h("span", {}, `.${value.output}`),
      ),
      h("small", {}, sizeOf(value)),
    ),
    details,
  );
}

/** Long names break after an underscore. */
const breakable = (name) => name.split(/(?<=_)/).flatMap((part) => [part, h("wbr")]);

function sizeOf(value) {
  const points =
    value.shown < value.count
      ? `${integer(value.shown)} of ${integer(value.count)}`
      : integer(value.count);
  return value.isMesh() ? `${integer(value.triangles.count)} triangles` : `${points} points`;
}

function controls(entry, refresh) {
  const { layer, value } = entry;
  const range = h("div", { class: "range" });
  const fillRange = () =>
    range.replaceChildren(
      ...(layer.isNumeric() ? rangeFields(entry, fillRange) : plainField(entry, refresh)),
    );
  const colour = choice(
    "colour",
    layer.colourings(),
    layer.key,
    (key) => {
      layer.colourBy(key);
      fillRange();
      refresh();
      entry.changed();
    },
    { "aria-label": `colour of ${value.id} by` },
  );
  fillRange();
  const opacity = slider("opacity", 0.1, 1, 0.05, layer.opacity, (x) => {
    layer.setOpacity(x);
    entry.changed();
  });
  const last = value.isMesh()
    ? tick("edges", false, (shown) => {
        layer.setEdges(shown);
        entry.changed();
      })
    : slider("size", 1, 10, 0.5, layer.size, (x) => {
        layer.size = x;
        entry.changed();
      });
  return [colour, range, h("div", { class: "pair" }, opacity, last)];
}

function slider(label, min, max, step, value, onInput) {
  const input = h("input", {
    type: "range",
    min,
    max,
    step,
    value,
    oninput: () => onInput(Number(input.value)),
  });
  return h("label", { class: "field" }, h("span", {}, label), input);
}

function plainField(entry, refresh) {
  const { layer } = entry;
  if (layer.key !== "plain") return [];
  const hex = `#${layer.plain.map((c) => c.toString(16).padStart(2, "0")).join("")}`;
  const input = h("input", {
    type: "color",
    value: hex,
    "aria-label": `colour of ${entry.value.id}`,
    oninput: () => {
      layer.setPlain([1, 3, 5].map((at) => parseInt(input.value.slice(at, at + 2), 16)));
      refresh();
      entry.changed();
    },
  });
  return [h("label", { class: "field" }, h("span", {}, "is"), input)];
}

/** From, to and map, in the unit of the legend. */
function rangeFields(entry, refill) {
  const { layer } = entry;
  const unit = layer.column ? layer.column.unit : "m";
  const [lo, hi] = layer.range;
  const scale = scaleFor(unit, Math.max(Math.abs(lo), Math.abs(hi)));
  const field = (label, value, set) => {
    const input = h("input", {
      type: "number",
      step: "any",
      value: Number((value * scale.factor).toPrecision(5)),
      onchange: () => {
        if (Number.isFinite(input.valueAsNumber)) set(input.valueAsNumber / scale.factor);
        entry.changed();
      },
    });
    return h(
      "label",
      { class: "field" },
      h("span", {}, label),
      input,
      scale.unit && h("small", {}, scale.unit),
    );
  };
  return [
    field("from", lo, (x) => layer.choose(x, layer.range[1])),
    field("to", hi, (x) => layer.choose(layer.range[0], x)),
    button(
      "all",
      () => {
        layer.choose(...layer.fullRange());
        refill();
        entry.changed();
      },
      { class: "small", title: "from the least to the greatest value" },
    ),
    choice(
      "map",
      mapNames.map((name) => [name, name]),
      layer.map,
      (map) => {
        layer.setMap(map);
        refill();
        entry.changed();
      },
    ),
  ];
}
