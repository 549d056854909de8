// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { number } from "../format.js";

const kMostTicks = 7;

/** A logarithmic axis with ticks at 1, 2, 5 or whole decades; linear where that cannot be. */
export function logAxis(values) {
  const finite = values.filter(Number.isFinite);
  if (finite.length === 0 || finite.some((x) => x <= 0)) return { type: "linear" };
  const lo = Math.floor(Math.log10(Math.min(...finite))) - 1;
  const hi = Math.ceil(Math.log10(Math.max(...finite))) + 1;
  const decades = Math.log10(Math.max(...finite) / Math.min(...finite));
  const leads = decades * 3 <= kMostTicks ? [1, 2, 5] : [1];
  const every = Math.max(1, Math.ceil(decades / kMostTicks));
  const tickvals = [];
  for (let power = lo; power <= hi; power += every)
    for (const lead of leads) tickvals.push(lead * 10 ** power);
  return { type: "log", tickmode: "array", tickvals, ticktext: tickvals.map((x) => number(x, 2)) };
}
