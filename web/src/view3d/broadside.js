// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

const kSample = 2000; // points of each value
const kAside = 0.45; // rad off the broadside, so that depth is seen
const kAbove = 0.3;

/**
 * A direction to look from: at the broad side of the values as they stand, from where the scanners
 * were, a little from the side and from above. Null without values.
 */
export function broadside(values) {
  const points = values.flatMap((value) => {
    const step = Math.max(1, Math.floor(value.shown / kSample));
    return Array.from({ length: Math.ceil(value.shown / step) }, (_, i) => value.point(i * step));
  });
  if (points.length === 0) return null;
  const middle = [0, 1].map((axis) => points.reduce((sum, p) => sum + p[axis], 0) / points.length);
  let xx = 0,
    xy = 0,
    yy = 0;
  for (const p of points) {
    const [x, y] = [p[0] - middle[0], p[1] - middle[1]];
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  // Across the longer axis of the spread on the ground.
  const angle = 0.5 * Math.atan2(2 * xy, xx - yy) - Math.PI / 2;
  const scanner = values.flatMap((value) => value.sensors)[0]?.position ?? [
    middle[0] + 1,
    middle[1] - 2,
  ];
  const side =
    Math.cos(angle) * (scanner[0] - middle[0]) + Math.sin(angle) * (scanner[1] - middle[1]) < 0
      ? Math.PI
      : 0;
  return [Math.cos(angle + side + kAside), Math.sin(angle + side + kAside), kAbove];
}
