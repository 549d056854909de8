// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

/**
 * The points that no other is better than in both measures, along x. `points` are { x, y };
 * `betterX`, `betterY` are "lower" or "higher"; null where a measure has no better direction.
 */
export function front(points, betterX, betterY) {
  const known = ["lower", "higher"];
  if (!known.includes(betterX) || !known.includes(betterY)) return null;
  const sx = betterX === "lower" ? 1 : -1;
  const sy = betterY === "lower" ? 1 : -1;
  const order = [...points].sort((a, b) => sx * (a.x - b.x) || sy * (a.y - b.y));
  const best = [];
  for (const point of order)
    if (best.length === 0 || sy * (point.y - best.at(-1).y) < 0) best.push(point);
  return best;
}
