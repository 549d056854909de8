// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Places the nodes of a graph in layers (after Sugiyama): a node's layer is the longest way to it;
// within its layer it lies near the middle of those that it is wired to. Wires over several layers
// take a place in each, so that they go around nodes.
import { settle, straighten } from "./settle.js";

const kSweeps = 16;
const kLast = 6;

/** Wires of a run's nodes: { from, to, output, input, type }. */
export function wiresOf(nodes) {
  const known = new Set(nodes.map((node) => node.name));
  return nodes
    .flatMap((node) =>
      Object.entries(node.in ?? {}).flatMap(([input, wires]) =>
        [wires]
          .flat()
          .filter(Boolean)
          .map((wire) => {
            const [from, output] = split(wire.from, known);
            return { from, output, to: node.name, input, type: wire.type };
          }),
      ),
    )
    .filter((wire) => known.has(wire.from));
}

/** "node.output", where a node's name may have dots itself. */
function split(text, known) {
  if (known.has(text)) return [text, ""];
  const dot = text.lastIndexOf(".");
  return [text.slice(0, dot), text.slice(dot + 1)];
}

/**
 * `size` is a node's extent across the layers, `gap` the room between two, `thin` that of a wire.
 * Returns { at: name -> { layer, across }, routes: wire -> [{ layer, across }], layers, extent }, where
 * `across` is the middle.
 */
export function layOut(nodes, wires, { size, gap, thin }) {
  const layer = layersOf(nodes, wires);
  const items = new Map(
    nodes.map(({ name }) => [
      name,
      { layer: layer.get(name), size, links: [], back: [], forth: [] },
    ]),
  );
  const routes = new Map(wires.map((wire) => [wire, routeOf(wire, items, thin)]));
  for (const route of routes.values())
    for (let i = 1; i < route.length; ++i) link(items.get(route[i - 1]), items.get(route[i]));
  const columns = [];
  for (const item of items.values()) (columns[item.layer] ??= []).push(item);
  for (const column of columns)
    column.forEach((item, i) => {
      item.across = i * (size + gap);
    });
  arrange(columns, gap);
  straighten(columns, gap, size);
  const low = Math.min(...[...items.values()].map((item) => item.across - item.size / 2));
  const place = (name) => ({ layer: items.get(name).layer, across: items.get(name).across - low });
  return {
    at: new Map(nodes.map(({ name }) => [name, place(name)])),
    routes: new Map([...routes].map(([wire, route]) => [wire, route.map(place)])),
    layers: columns.length,
    extent: Math.max(...[...items.values()].map((item) => item.across + item.size / 2)) - low,
  };
}

function arrange(columns, gap) {
  for (let sweep = 0; sweep < kSweeps; ++sweep) {
    const forward = sweep % 2 === 0;
    // First by one side, to find the order; at last by both, to find the middle.
    const side = sweep >= kSweeps - kLast ? "links" : forward ? "back" : "forth";
    for (const column of forward ? columns : [...columns].reverse()) settle(column, side, gap);
  }
}

function link(a, b) {
  a.forth.push(b);
  b.back.push(a);
  a.links.push(b);
  b.links.push(a);
}

/** The names along a wire: its ends and a place in each layer between; wires of one node share these. */
function routeOf(wire, items, thin) {
  const route = [wire.from];
  for (let layer = items.get(wire.from).layer + 1; layer < items.get(wire.to).layer; ++layer) {
    const name = `${wire.from}\n${wire.type}\n${layer}`;
    if (!items.has(name)) items.set(name, { layer, size: thin, links: [], back: [], forth: [] });
    route.push(name);
  }
  return [...route, wire.to];
}

function layersOf(nodes, wires) {
  const layer = new Map(nodes.map((node) => [node.name, 0]));
  for (let changed = true, turns = 0; changed && turns <= nodes.length; ++turns) {
    changed = false;
    for (const { from, to } of wires) {
      if (layer.get(to) > layer.get(from)) continue;
      layer.set(to, layer.get(from) + 1);
      changed = true;
    }
  }
  // A source stands right before the first that cannot do with it alone, and its own sinks after it.
  const givers = (name) =>
    new Set(wires.filter((wire) => wire.to === name).map((wire) => wire.from));
  for (const { name } of nodes) {
    if (givers(name).size) continue;
    const takers = wires.filter((wire) => wire.from === name).map((wire) => wire.to);
    const others = takers.filter(
      (taker) => givers(taker).size > 1 || wires.some((wire) => wire.from === taker),
    );
    if (others.length) layer.set(name, Math.min(...others.map((taker) => layer.get(taker))) - 1);
    for (const taker of takers) if (!others.includes(taker)) layer.set(taker, layer.get(name) + 1);
  }
  return layer;
}
