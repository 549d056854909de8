// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { h, s } from "../dom.js";
import { bytes, seconds } from "../format.js";
import { layOut, wiresOf } from "./layout.js";

const kWide = 164;
const kHigh = 52;
const kGapX = 46;
const kGapY = 14;
const kEdge = 8;

const kSigns = { ok: "\u2713", cached: "\u21ba", failed: "\u2715", skipped: "\u2013", interrupted: "!" };

/** The graph as SVG; `open(name)` when a node is chosen. */
export function drawGraph(run, open) {
  const wires = wiresOf(run.nodes);
  const places = layOut(run.nodes, wires);
  const at = new Map([...places].map(([name, place]) => [name, { x: kEdge + place.layer * (kWide + kGapX), y: kEdge + place.row * (kHigh + kGapY) }]));
  const width = Math.max(...[...at.values()].map((p) => p.x)) + kWide + kEdge;
  const height = Math.max(...[...at.values()].map((p) => p.y)) + kHigh + kEdge;
  const longest = Math.max(...run.nodes.map((node) => node.seconds ?? 0), 1e-9);
  const picture = s("svg", { class: "graph", viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": `graph of ${run.nodes.length} nodes`, style: { minWidth: `${Math.round(width * 0.66)}px`, maxWidth: `${Math.round(width * 1.15)}px` } },
    wires.map((wire) => edge(wire, at)),
    run.nodes.map((node) => box(node, at.get(node.name), longest, open)));
  return h("div", { class: "scroll graph-frame", tabindex: "0", role: "region", "aria-label": "graph" }, picture, legend(run));
}

function edge(wire, at) {
  const a = at.get(wire.from);
  const b = at.get(wire.to);
  const x0 = a.x + kWide, y0 = a.y + kHigh / 2, x1 = b.x, y1 = b.y + kHigh / 2;
  const bend = Math.max(22, (x1 - x0) / 2);
  return s("path", { class: `wire ${wire.type ?? ""}`, d: `M${x0} ${y0} C${x0 + bend} ${y0} ${x1 - bend} ${y1} ${x1} ${y1}` },
    s("title", {}, `${wire.from}.${wire.output} \u2192 ${wire.to}.${wire.input} (${wire.type})`));
}

function box(node, place, longest, open) {
  const facts = [node.seconds !== null && node.status !== "skipped" ? seconds(node.seconds) : null, node.peak_bytes ? bytes(node.peak_bytes) : null].filter(Boolean).join(" \u00b7 ");
  const share = Math.sqrt((node.seconds ?? 0) / longest);
  const act = () => open(node.name);
  const self = s("g", {
    class: `node ${node.status}`, transform: `translate(${place.x} ${place.y})`, tabindex: "0", role: "link",
    "aria-label": `${node.name}, ${node.use}, ${node.status}${facts ? `, ${facts}` : ""}`, onclick: act,
    onkeydown: (event) => { if (event.key === "Enter" || event.key === " ") { event.preventDefault(); act(); } },
  },
  s("title", {}, `${node.name}: ${node.use}\n${node.status}${facts ? `, ${facts}` : ""}${node.warnings?.length ? `\n${node.warnings.join("\n")}` : ""}`),
  s("rect", { class: "body", width: kWide, height: kHigh, rx: 7 }),
  s("text", { class: "name", x: 10, y: 18 }, fitted(node.name, 19)),
  s("text", { class: "use", x: 10, y: 32 }, fitted(node.use, 27)),
  s("text", { class: "facts", x: 10, y: 45 }, facts || node.status),
  s("circle", { class: "state", cx: kWide - 14, cy: 14, r: 8 }),
  s("text", { class: "sign", x: kWide - 14, y: 17.5, "text-anchor": "middle" }, kSigns[node.status] ?? "?"),
  s("rect", { class: "time", x: 4, y: kHigh - 4, width: Math.max(0, share * (kWide - 8)), height: 2.5, rx: 1 }));
  if (node.warnings?.length) self.append(s("text", { class: "warn", x: kWide - 32, y: 18, "text-anchor": "middle" }, "\u26a0"));
  return self;
}

const fitted = (text, most) => (text.length > most ? `${text.slice(0, most - 1)}\u2026` : text);

function legend(run) {
  const states = [...new Set(run.nodes.map((node) => node.status))];
  return h("p", { class: "hint graph-legend" },
    states.map((state) => h("span", { class: `state-key ${state}` }, h("i", {}, kSigns[state] ?? "?"), state)),
    "The line under a node is its time (square root). Memory is known where a node ran alone.");
}
