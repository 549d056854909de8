// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Picks as text for a graph. Lengths carry their unit, so that the graph's `units` do not matter.

const length = (x) => `"${x.toFixed(5).replace(/^-(0\.0+)$/, "$1")} m"`;
const place = (point) => `[${point.map(length).join(", ")}]`;
const bare = (name) => /^[A-Za-z0-9_-]+$/.test(name);
const key = (name) => (bare(name) ? name : JSON.stringify(name));

/**
 * A node that removes the picked points, for each value that was picked in. Of a mesh or clusters they
 * are removed from the cloud that these were made of.
 */
export function cleaningToml(picks, nodes = []) {
  const texts = [...grouped(picks)].map(([id, list]) => {
    const [{ value }] = list;
    const cloud = cloudOf(id, value.type, nodes);
    if (!cloud) return `# ${id} was made of no cloud from which points could be removed`;
    return [
      `[node.${key(`${cloud.slice(0, cloud.lastIndexOf("."))}_cleaned`)}]`,
      `use = "filtering.remove_points"`,
      `in = ${JSON.stringify(cloud)}${cloud === id ? "" : `  # of which ${id} was made`}`,
      `points = [`,
      ...list.map(({ point, index }) => `  ${place(point)},  # point ${index}`),
      `]`,
    ].join("\n");
  });
  return texts.join("\n\n");
}

/**
 * Pairs of picks for registration.planes: the first pick in one value goes with the first in the other.
 * Source and target are those of a registration that takes both values, else in the order of picking.
 * Null unless two values were picked in equally often.
 */
export function picksToml(picks, nodes = []) {
  const groups = [...grouped(picks)];
  if (groups.length !== 2 || groups[0][1].length !== groups[1][1].length) return null;
  const ids = groups.map(([id]) => id);
  const taker = nodes.find(
    (node) =>
      ids.includes(node.in?.source?.from) &&
      ids.includes(node.in?.target?.from) &&
      node.in.source.from !== node.in.target.from,
  );
  if (taker && taker.in.source.from === ids[1]) groups.reverse();
  const [sources, targets] = groups.map(([, list]) => list);
  return [
    `# in the node ${taker ? `[node.${key(taker.name)}]` : "that uses registration.planes"}: source ${groups[0][0]}, target ${groups[1][0]}`,
    `picks = [`,
    ...sources.map(
      (source, i) => `  { source = ${place(source.point)}, target = ${place(targets[i].point)} },`,
    ),
    `]`,
  ].join("\n");
}

/** The id of the cloud itself, or of that which its node took, or a node before; null without one. */
function cloudOf(id, type, nodes, depth = 0) {
  if (type === "cloud") return id;
  const node = nodes.find(
    (one) => id.startsWith(`${one.name}.`) && !id.slice(one.name.length + 1).includes("."),
  );
  const wires = Object.values(node?.in ?? {})
    .flat()
    .filter((wire) => wire?.from);
  const next = wires.find((wire) => wire.type === "cloud") ?? wires[0];
  return next && depth < nodes.length ? cloudOf(next.from, next.type, nodes, depth + 1) : null;
}

function grouped(picks) {
  const groups = new Map();
  for (const pick of picks) groups.set(pick.value.id, [...(groups.get(pick.value.id) ?? []), pick]);
  return groups;
}
