// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Where the items of one layer lie: { across, size, links, back, forth }, `across` being the middle.

const kRounds = 4;
const kNearly = 0.45; // of a node's size: wires that are this little bent are made straight

const room = (a, b, gap) => (a.size + b.size) / 2 + gap;

/**
 * Sorts a layer by the mean place of its neighbours on `side` and puts each item as near to it as the
 * others leave room, in the least-squares sense.
 */
export function settle(column, side, gap) {
  for (const item of column)
    item.wanted = item[side].length
      ? item[side].reduce((sum, other) => sum + other.across, 0) / item[side].length
      : item.across;
  column.sort((a, b) => a.wanted - b.wanted);
  // Blocks of items that touch move together: their place is the mean of what they want.
  const blocks = [];
  let offset = 0;
  column.forEach((item, i) => {
    if (i > 0) offset += room(column[i - 1], item, gap);
    blocks.push({ items: [{ item, offset }], sum: item.wanted - offset });
    while (blocks.length > 1 && mean(blocks.at(-2)) > mean(blocks.at(-1))) {
      const last = blocks.pop();
      blocks.at(-1).items.push(...last.items);
      blocks.at(-1).sum += last.sum;
    }
  });
  for (const block of blocks)
    for (const { item, offset: own } of block.items) item.across = mean(block) + own;
}

const mean = (block) => block.sum / block.items.length;

/** Takes out small bends where there is room. */
export function straighten(columns, gap, size) {
  for (let round = 0; round < kRounds; ++round)
    for (const column of columns)
      column.forEach((item, i) => {
        const near = [...item.back, ...item.forth].filter(
          (other) => Math.abs(other.across - item.across) < kNearly * size,
        );
        if (near.length === 0) return;
        const low = i > 0 ? column[i - 1].across + room(column[i - 1], item, gap) : -Infinity;
        const high =
          i + 1 < column.length ? column[i + 1].across - room(item, column[i + 1], gap) : Infinity;
        const goal = near.reduce(
          (best, other) =>
            Math.abs(other.across - item.across) < Math.abs(best - item.across)
              ? other.across
              : best,
          near[0].across,
        );
        if (goal >= low && goal <= high) item.across = goal;
      });
}
