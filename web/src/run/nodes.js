// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Every node with its parameters, measures, wires and warnings.
import { button, h } from "../dom.js";
import { bytes, integer, parameter, quantity, seconds } from "../format.js";

export function nodesSection(run, stages) {
  const cards = run.nodes.map((node) => card(node, stages[node.use]));
  window.addEventListener("hashchange", () => {
    const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (target?.classList.contains("node-card")) target.open = true;
  });
  const all = (open) =>
    cards.forEach((one) => {
      one.open = open;
    });
  return [
    h(
      "div",
      { class: "buttons" },
      button("Open all", () => all(true)),
      button("Close all", () => all(false)),
    ),
    h("div", { class: "nodes" }, cards),
  ];
}

/** Brings a node's card into sight. */
export function openNode(name) {
  const self = document.getElementById(`node-${name}`);
  if (!self) return;
  self.open = true;
  self.scrollIntoView({
    block: "start",
    behavior: matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth",
  });
  self.querySelector("summary").focus({ preventScroll: true });
}

function card(node, stage) {
  const told = Object.entries(node.measures ?? {})
    .slice(0, 4)
    .map(([name, measure]) => `${name} ${quantity(measure.value, measure.unit)}`)
    .join(", ");
  return h(
    "details",
    { class: `node-card ${node.status}`, id: `node-${node.name}` },
    h(
      "summary",
      {},
      h("span", { class: `status ${node.status}` }, node.status),
      " ",
      h("b", {}, node.name),
      " ",
      h("code", {}, node.use),
      h(
        "span",
        { class: "cost" },
        [
          node.status === "skipped" ? null : seconds(node.seconds),
          node.peak_bytes ? bytes(node.peak_bytes) : null,
        ]
          .filter(Boolean)
          .join(" \u00b7 "),
      ),
      told && h("small", { class: "told" }, told),
    ),
    h(
      "div",
      { class: "node-body" },
      stage?.summary && h("p", {}, stage.summary),
      node.error &&
        h(
          "p",
          { class: "banner failed" },
          h("b", {}, node.error.code),
          ` ${node.error.message}`,
          node.error.hint && h("i", {}, ` ${node.error.hint}`),
        ),
      (node.warnings ?? []).map((text) => h("p", { class: "banner warning" }, text)),
      h(
        "div",
        { class: "columns" },
        measures(node),
        parameters(node, stage),
        wires("from", node.in),
        wires("made", node.out),
      ),
      h(
        "p",
        { class: "hint" },
        `version ${node.version}, plugin ${node.plugin_hash}${node.cpu_seconds === null || node.cpu_seconds === undefined ? "" : `, ${seconds(node.cpu_seconds)} of processor time`}`,
      ),
    ),
  );
}

const block = (title, rows) =>
  rows.length > 0 && h("div", {}, h("h3", {}, title), h("table", {}, h("tbody", {}, rows)));

function measures(node) {
  const arrows = { lower: ["\u2193", "lower is better"], higher: ["\u2191", "higher is better"] };
  return block(
    "Measures",
    Object.entries(node.measures ?? {}).map(([name, { value, unit, better }]) =>
      h(
        "tr",
        {},
        h("th", { scope: "row" }, name),
        h("td", { class: "n", title: `${value} ${unit}` }, quantity(value, unit)),
        h(
          "td",
          { class: "better", title: arrows[better]?.[1], "aria-label": arrows[better]?.[1] },
          arrows[better]?.[0] ?? "",
        ),
      ),
    ),
  );
}

function parameters(node, stage) {
  return block(
    "Parameters",
    Object.entries(node.parameters ?? {}).map(([name, value]) => {
      const known = stage?.parameters?.find((one) => one.name === name);
      return h(
        "tr",
        { title: known?.doc },
        h("th", { scope: "row" }, name),
        h("td", {}, parameter(value, known?.unit)),
      );
    }),
  );
}

const kCounts = [
  "points",
  "triangles",
  "vertices",
  "clusters",
  "pairs",
  "rows",
  "control_points",
  "sensors",
];

function wires(title, ports) {
  const rows = Object.entries(ports ?? {}).flatMap(([port, values]) =>
    [values]
      .flat()
      .filter(Boolean)
      .map((value) =>
        h(
          "tr",
          {},
          h("th", { scope: "row" }, port),
          h(
            "td",
            {},
            value.from ? `${value.from}: ` : "",
            value.type,
            ...kCounts
              .filter((key) => value[key])
              .map((key) => `, ${integer(value[key])} ${key.replace("_", " ")}`),
            Array.isArray(value.columns) &&
              value.columns.length > 0 &&
              h("small", {}, ` ${value.columns.join(", ")}`),
            value.hash &&
              h(
                "small",
                { class: "hash", title: "XXH3-128 of the content" },
                ` ${value.hash.slice(0, 12)}\u2026`,
              ),
          ),
        ),
      ),
  );
  return block(title === "from" ? "Inputs" : "Outputs", rows);
}
