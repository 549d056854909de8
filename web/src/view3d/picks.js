// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// The list of picked points under a view, and what can be copied from it.
import { button, copyButton, h } from "../dom.js";
import { number, quantity } from "../format.js";
import { labelName } from "../data/value.js";
import { cleaningToml, picksToml } from "./toml.js";

export class Picks {
  /** `view` has marks; `nodes` are those of the run, to name nodes that take picks. */
  constructor(view, nodes) {
    this.view = view;
    this.nodes = nodes;
    this.list = [];
    this.element = h("section", {
      class: "picks",
      "aria-live": "polite",
      "aria-label": "picked points",
    });
    view.on("pick", (found) => found && this.add(found.layer.value, found.index));
    view.onDelete = () => this.remove(this.list.length - 1);
    this.refresh();
  }

  add(value, index) {
    const pick = { value, index, point: value.point(index) };
    this.list.push(pick);
    this.refresh();
  }

  remove(at) {
    if (at < 0) return;
    this.list.splice(at, 1);
    this.refresh();
  }

  clear() {
    this.list = [];
    this.refresh();
  }

  refresh() {
    for (const mark of this.marks ?? []) mark.remove();
    this.marks = this.list.map((pick, i) => this.view.marks.add(pick.point, String(i + 1), "pick"));
    this.view.draw();
    if (this.list.length === 0) {
      this.element.replaceChildren(
        h(
          "p",
          { class: "hint" },
          "Click a point, or press Enter in the view for the one at its centre: its place and columns appear here, to be copied as TOML.",
        ),
      );
      return;
    }
    this.element.replaceChildren(this.#table(), this.#copies());
  }

  #table() {
    const rows = this.list.map((pick, i) =>
      h(
        "tr",
        {},
        h("th", { scope: "row" }, h("span", { class: "mark pick inline" }, h("b", {}, i + 1))),
        h("td", {}, pick.value.id),
        h("td", { class: "n" }, `#${number(pick.index)}`),
        pick.point.map((x) => h("td", { class: "n" }, x.toFixed(4))),
        h("td", { class: "n" }, pick.point.map((x) => (1000 * x).toFixed(1)).join(", ")),
        h("td", {}, columnsText(pick)),
        h(
          "td",
          { class: "n" },
          i > 0 && pick.value !== this.list[i - 1].value
            ? ""
            : i > 0
              ? quantity(distance(pick.point, this.list[i - 1].point), "m")
              : "",
        ),
        h(
          "td",
          {},
          button("\u00d7", () => this.remove(i), {
            class: "small",
            "aria-label": `remove pick ${i + 1}`,
          }),
        ),
      ),
    );
    const heads = [
      "",
      "value",
      "point",
      "x [m]",
      "y [m]",
      "z [m]",
      "x, y, z [mm]",
      "columns",
      "from the one before",
      "",
    ];
    return h(
      "div",
      { class: "scroll" },
      h(
        "table",
        {},
        h(
          "thead",
          {},
          h(
            "tr",
            {},
            heads.map((text) => h("th", { scope: "col" }, text)),
          ),
        ),
        h("tbody", {}, rows),
      ),
    );
  }

  #copies() {
    const step = Math.max(...this.list.flatMap((pick) => pick.value.step())) / 2;
    const pairs = picksToml(this.list, this.nodes);
    const shown = h(
      "details",
      {},
      h("summary", {}, "as TOML"),
      h(
        "pre",
        { class: "toml" },
        [pairs, cleaningToml(this.list, this.nodes)].filter(Boolean).join("\n\n"),
      ),
    );
    return h(
      "div",
      {},
      h(
        "div",
        { class: "buttons" },
        pairs && copyButton("Copy as picks", () => pairs, { class: "copy-picks" }),
        copyButton("Copy for filtering.remove_points", () => cleaningToml(this.list, this.nodes), {
          class: "copy-remove",
        }),
        button("Clear", () => this.clear()),
        h(
          "small",
          {},
          `Places are right to \u00b1${quantity(step, "m", 2)}, the rounding of this page; each is in the frame of its value.`,
        ),
      ),
      shown,
    );
  }
}

const distance = (a, b) => Math.hypot(...a.map((x, axis) => x - b[axis]));

function columnsText({ value, index }) {
  return (
    value.columns
      .map((column) => {
        const entry = value.entry(column, index);
        const text =
          column.kind === "number" ? quantity(entry, column.unit) : labelName(column, entry);
        return `${column.name} ${text}`;
      })
      .join(", ") || "\u2013"
  );
}
