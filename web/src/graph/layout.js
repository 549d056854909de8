// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Places the nodes of a graph in layers from left to right (after Sugiyama): a node's layer is the
// longest way to it; within a layer, nodes are put near the middle of those that they are wired to.

const kSweeps = 12;

/** Wires of a run's nodes: { from, to, output, input, type }. */
export function wiresOf(nodes) {
  const known = new Set(nodes.map((node) => node.name));
  return nodes.flatMap((node) => Object.entries(node.in ?? {}).flatMap(([input, wires]) =>
    [wires].flat().filter(Boolean).map((wire) => {
      const [from, output] = split(wire.from, known);
      return { from, output, to: node.name, input, type: wire.type };
    }))).filter((wire) => known.has(wire.from));
}

/** "node.output", where a node's name may have dots itself. */
function split(text, known) {
  if (known.has(text)) return [text, ""];
  const dot = text.lastIndexOf(".");
  return [text.slice(0, dot), text.slice(dot + 1)];
}

/** For each node its layer and row; rows may be halves. */
export function layOut(nodes, wires) {
  const layer = layersOf(nodes, wires);
  const columns = [];
  for (const node of nodes) (columns[layer.get(node.name)] ??= []).push(node.name);
  const before = new Map(nodes.map(({ name }) => [name, wires.filter((w) => w.to === name).map((w) => w.from)]));
  const after = new Map(nodes.map(({ name }) => [name, wires.filter((w) => w.from === name).map((w) => w.to)]));
  const row = new Map();
  for (const column of columns) column.forEach((name, i) => row.set(name, i));
  for (let sweep = 0; sweep < kSweeps; ++sweep) {
    const forward = sweep % 2 === 0;
    for (const column of forward ? columns : [...columns].reverse())
      settle(column, row, forward ? before : after, sweep >= kSweeps - 4 ? new Map([...before].map(([name, list]) => [name, [...list, ...after.get(name)]])) : null);
  }
  const least = Math.min(...row.values());
  return new Map(nodes.map(({ name }) => [name, { layer: layer.get(name), row: row.get(name) - least }]));
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
  // A source stands right before the first that takes it.
  for (const { name } of nodes) {
    const takers = wires.filter((wire) => wire.from === name);
    if (takers.length && !wires.some((wire) => wire.to === name))
      layer.set(name, Math.min(...takers.map((wire) => layer.get(wire.to))) - 1);
  }
  return layer;
}

/** Sorts a column by where its neighbours are and spaces it by at least one row. */
function settle(column, row, neighbours, both) {
  const wanted = new Map(column.map((name) => {
    const list = (both ?? neighbours).get(name);
    return [name, list.length ? list.reduce((sum, other) => sum + row.get(other), 0) / list.length : row.get(name)];
  }));
  column.sort((a, b) => wanted.get(a) - wanted.get(b));
  // Least squares under "one row apart": neighbouring blocks that would overlap share their mean.
  const blocks = [];
  column.forEach((name, i) => {
    blocks.push({ first: i, count: 1, sum: wanted.get(name) - i });
    while (blocks.length > 1 && mean(blocks.at(-2)) > mean(blocks.at(-1))) {
      const last = blocks.pop();
      blocks.at(-1).count += last.count;
      blocks.at(-1).sum += last.sum;
    }
  });
  for (const block of blocks)
    for (let i = block.first; i < block.first + block.count; ++i) row.set(column[i], mean(block) + i);
}

const mean = (block) => block.sum / block.count;
