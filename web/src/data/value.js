// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

const kSteps = 65535; // of a quantised position
const kNoNumber = 65535; // in a column of numbers

/** A value of the run: what the JSON says, and its arrays as views into the block of binary data. */
export class Value {
  constructor(json, block) {
    Object.assign(this, json);
    this.block = block;
    this.columns ??= [];
    this.sensors ??= [];
  }

  hasShape() {
    return Boolean(this.positions) && this.shown > 0;
  }

  isMesh() {
    return Boolean(this.triangles) && this.triangles.count > 0;
  }

  /** Quantised positions, x y z of each point in turn. */
  quantised() {
    return new Uint16Array(this.block, this.positions.at, this.shown * 3);
  }

  /** Metres from `corner()`, in single precision. Made once. */
  local() {
    if (!this.localPositions) {
      const q = this.quantised();
      const step = this.step();
      const local = new Float32Array(q.length);
      for (let i = 0; i < q.length; i += 3) {
        local[i] = q[i] * step[0];
        local[i + 1] = q[i + 1] * step[1];
        local[i + 2] = q[i + 2] * step[2];
      }
      this.localPositions = local;
    }
    return this.localPositions;
  }

  /** Metres between two quantised positions, by axis. */
  step() {
    const { lo, hi } = this.positions;
    return [0, 1, 2].map((axis) => (hi[axis] - lo[axis]) / kSteps);
  }

  /** Where quantised 0 lies in the value's frame [m]. */
  corner() {
    return [0, 1, 2].map((axis) => this.origin[axis] + this.positions.lo[axis]);
  }

  /** A point in the value's frame [m], in double precision. */
  point(index) {
    const q = this.quantised();
    const step = this.step();
    return this.corner().map((corner, axis) => corner + q[3 * index + axis] * step[axis]);
  }

  /** Lowest and highest corner in the value's frame [m]. */
  bounds() {
    const { lo, hi } = this.positions;
    return [lo, hi].map((corner) => corner.map((x, axis) => x + this.origin[axis]));
  }

  indices() {
    const Kind = this.triangles.bits === 16 ? Uint16Array : Uint32Array;
    return new Kind(this.block, this.triangles.at, this.triangles.count * 3);
  }

  column(name) {
    return this.columns.find((column) => column.name === name);
  }

  /** The raw integers of a column. */
  raw(column) {
    const Kind = column.kind === "label" && column.bits === 32 ? Uint32Array : Uint16Array;
    return new Kind(this.block, column.at, this.shown);
  }

  /** A point's entry: a number, a label as integer or name, or null for none. */
  entry(column, index) {
    const raw = this.raw(column)[index];
    if (column.kind === "number") {
      if (raw === kNoNumber) return null;
      return column.lo + (raw / (kNoNumber - 1)) * (column.hi - column.lo);
    }
    return raw === noLabel(column) ? null : raw;
  }

  /** The number below which this share of a column lies; null where it has none. */
  quantile(column, share) {
    column.counts ??= countSteps(this.raw(column));
    const { counts, total } = column.counts;
    let below = 0;
    for (let step = 0; step < kNoNumber; ++step) {
      below += counts[step];
      if (below >= share * total && total > 0)
        return column.lo + (step / (kNoNumber - 1)) * (column.hi - column.lo);
    }
    return column.hi;
  }

  /** The labels that occur, in order, with how many points have each; null for none comes last. */
  labels(column) {
    column.occurring ??= countLabels(this.raw(column), noLabel(column));
    return column.occurring;
  }
}

const noLabel = (column) => (column.bits === 32 ? 0xffffffff : 0xffff);

function countSteps(raw) {
  const counts = new Uint32Array(kNoNumber + 1);
  for (const step of raw) ++counts[step];
  return { counts, total: raw.length - counts[kNoNumber] };
}

function countLabels(raw, none) {
  const counts = new Map();
  for (const label of raw) counts.set(label, (counts.get(label) ?? 0) + 1);
  const labels = [...counts].filter(([label]) => label !== none).sort((a, b) => a[0] - b[0]);
  if (counts.has(none)) labels.push([null, counts.get(none)]);
  return labels.map(([label, count]) => ({ label, count }));
}

const kGrades = ["good", "fair", "bad"]; // of analysis.displacement

export function labelName(column, label) {
  if (label === null) return "none";
  const names = column.names ?? (column.name === "grade" ? kGrades : []);
  return names[label] ?? String(label);
}
