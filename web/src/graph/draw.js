// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { h, s } from "../dom.js";
import { bytes, seconds } from "../format.js";
import { layOut, wiresOf } from "./layout.js";

const kWide = 182;
const kHigh = 58;
const kEdge = 8;
const kPage = { width: 1340, height: 800 }; // what a graph should fit into, at its full size
const kSmall = 0.66; // below this scale from left to right, from top to bottom is tried

// Along the layers and across them: `along` is a layer's length with the room for wires.
const kSideways = { name: "sideways", size: kHigh, gap: 14, thin: 6, along: kWide + 40 };
const kDown = { name: "down", size: kWide, gap: 16, thin: 8, along: kHigh + 40 };

const kSigns = {
  ok: "\u2713",
  cached: "\u21ba",
  failed: "\u2715",
  skipped: "\u2013",
  interrupted: "!",
};

/** The graph as SVG; `open(name)` when a node is chosen. */
export function drawGraph(run, open) {
  const wires = wiresOf(run.nodes);
  const plan = best(run.nodes, wires);
  const at = new Map([...plan.at].map(([name, place]) => [name, corner(plan, place)]));
  const { width, height } = plan;
  const longest = Math.max(...run.nodes.map((node) => node.seconds ?? 0), 1e-9);
  const picture = s(
    "svg",
    {
      class: "graph",
      viewBox: `0 0 ${width.toFixed(0)} ${height.toFixed(0)}`,
      role: "group",
      "aria-label": `graph of ${run.nodes.length} nodes`,
      style: {
        minWidth: `${Math.round(width * 0.55)}px`,
        maxWidth: `${Math.round(width * 1.05)}px`,
      },
    },
    wires.map((wire) => edge(wire, plan)),
    run.nodes.map((node) => box(node, at.get(node.name), longest, open)),
  );
  return h(
    "div",
    { class: "scroll graph-frame", tabindex: "0", role: "region", "aria-label": "graph" },
    picture,
    legend(run),
  );
}

/** From left to right, or from top to bottom where that leaves the text larger. */
function best(nodes, wires) {
  const [sideways, down] = [kSideways, kDown].map((way) => {
    const plan = layOut(nodes, wires, way);
    const along = (plan.layers - 1) * way.along + (way === kDown ? kHigh : kWide) + 2 * kEdge;
    const across = plan.extent + 2 * kEdge;
    const [width, height] = way === kDown ? [across, along] : [along, across];
    return {
      ...plan,
      way,
      width,
      height,
      scale: Math.min(1, kPage.width / width, kPage.height / height),
    };
  });
  return sideways.scale < kSmall && down.scale > sideways.scale ? down : sideways;
}

/** The upper left corner of a node. */
function corner({ way }, { layer, across }) {
  const along = kEdge + layer * way.along;
  return way === kDown
    ? { x: kEdge + across - kWide / 2, y: along }
    : { x: along, y: kEdge + across - kHigh / 2 };
}

function edge(wire, plan) {
  const route = plan.routes.get(wire);
  const { way } = plan;
  const deep = way === kDown ? kHigh : kWide;
  const point = (along, across) =>
    way === kDown
      ? `${across.toFixed(1)} ${along.toFixed(1)}`
      : `${along.toFixed(1)} ${across.toFixed(1)}`;
  // Straight through the places between, bent in the room between layers.
  let path = "";
  for (let i = 0; i + 1 < route.length; ++i) {
    const [a, b] = [route[i], route[i + 1]];
    const from = kEdge + a.layer * way.along + deep,
      to = kEdge + b.layer * way.along;
    const half = (from + to) / 2,
      x = kEdge + a.across,
      y = kEdge + b.across;
    path += `${i === 0 ? `M${point(from, x)}` : `L${point(from, x)}`} C${point(half, x)} ${point(half, y)} ${point(to, y)}`;
  }
  return s(
    "path",
    { class: `wire ${wire.type ?? ""}`, d: path },
    s("title", {}, `${wire.from}.${wire.output} \u2192 ${wire.to}.${wire.input} (${wire.type})`),
  );
}

function box(node, place, longest, open) {
  const facts = [
    node.seconds !== null && node.status !== "skipped" ? seconds(node.seconds) : null,
    node.peak_bytes ? bytes(node.peak_bytes) : null,
  ]
    .filter(Boolean)
    .join(" \u00b7 ");
  const share = Math.sqrt((node.seconds ?? 0) / longest);
  const act = () => open(node.name);
  const self = s(
    "g",
    {
      class: `node ${node.status}`,
      transform: `translate(${place.x} ${place.y})`,
      tabindex: "0",
      role: "link",
      "aria-label": `${node.name}, ${node.use}, ${node.status}${facts ? `, ${facts}` : ""}`,
      onclick: act,
      onkeydown: (event) => {
        if (event.key === "Enter" || event.key === " ") {
          event.preventDefault();
          act();
        }
      },
    },
    s(
      "title",
      {},
      `${node.name}: ${node.use}\n${node.status}${facts ? `, ${facts}` : ""}${node.warnings?.length ? `\n${node.warnings.join("\n")}` : ""}`,
    ),
    s("rect", { class: "body", width: kWide, height: kHigh, rx: 7 }),
    s("text", { class: "name", x: 10, y: 19 }, fitted(node.name, node.warnings?.length ? 16 : 18)),
    s("text", { class: "use", x: 10, y: 34.5 }, fitted(node.use, 30)),
    s("text", { class: "facts", x: 10, y: 49 }, facts || node.status),
    s("circle", { class: "state", cx: kWide - 14, cy: 14, r: 8 }),
    s(
      "text",
      { class: "sign", x: kWide - 14, y: 17.5, "text-anchor": "middle" },
      kSigns[node.status] ?? "?",
    ),
    s("rect", {
      class: "time",
      x: 4,
      y: kHigh - 4,
      width: Math.max(0, share * (kWide - 8)),
      height: 2.5,
      rx: 1,
    }),
  );
  if (node.warnings?.length)
    self.append(
      s("text", { class: "warn", x: kWide - 32, y: 18, "text-anchor": "middle" }, "\u26a0"),
    );
  return self;
}

const fitted = (text, most) => (text.length > most ? `${text.slice(0, most - 1)}\u2026` : text);

function legend(run) {
  const states = [...new Set(run.nodes.map((node) => node.status))];
  return h(
    "p",
    { class: "hint graph-legend" },
    states.map((state) =>
      h("span", { class: `state-key ${state}` }, h("i", {}, kSigns[state] ?? "?"), state),
    ),
    "The line under a node is its time (square root). Memory is known where a node ran alone.",
  );
}
