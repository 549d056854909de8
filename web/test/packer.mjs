// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Makes reports as the command does (see "The data" in the README): quantised arrays in one block.

export class Packer {
  constructor() {
    this.parts = [];
    this.size = 0;
  }

  /** Appends the array, padded to a multiple of 4; returns where it starts. */
  put(array) {
    const at = this.size;
    const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
    const padded = new Uint8Array(Math.ceil(bytes.length / 4) * 4);
    padded.set(bytes);
    this.parts.push(padded);
    this.size += padded.length;
    return at;
  }

  /** `points` are [x, y, z] in metres. */
  positions(points) {
    const lo = [0, 1, 2].map((axis) =>
      points.reduce((least, p) => Math.min(least, p[axis]), Infinity),
    );
    const hi = [0, 1, 2].map((axis) =>
      points.reduce((most, p) => Math.max(most, p[axis]), -Infinity),
    );
    const q = new Uint16Array(points.length * 3);
    points.forEach((p, i) =>
      [0, 1, 2].forEach((axis) => {
        q[3 * i + axis] = Math.round(((p[axis] - lo[axis]) / (hi[axis] - lo[axis] || 1)) * 65535);
      }),
    );
    return { at: this.put(q), lo, hi };
  }

  numbers(name, unit, values) {
    const finite = values.filter((x) => x !== null);
    const lo = finite.reduce((a, b) => Math.min(a, b), Infinity);
    const hi = finite.reduce((a, b) => Math.max(a, b), -Infinity);
    const q = Uint16Array.from(values, (x) =>
      x === null ? 65535 : Math.round(((x - lo) / (hi - lo || 1)) * 65534),
    );
    return { name, unit, kind: "number", at: this.put(q), lo, hi };
  }

  labels(name, values, names) {
    return {
      name,
      unit: "",
      kind: "label",
      at: this.put(Uint16Array.from(values, (x) => (x < 0 ? 65535 : x))),
      bits: 16,
      ...(names && { names }),
    };
  }

  cloud(id, points, columns = [], more = {}) {
    const [node, output] = [id.slice(0, id.lastIndexOf(".")), id.slice(id.lastIndexOf(".") + 1)];
    return {
      id,
      node: node.slice(node.indexOf("/") + 1),
      output,
      type: "cloud",
      count: points.length,
      shown: points.length,
      origin: [0, 0, 0],
      positions: this.positions(points),
      columns,
      sensors: [],
      ...more,
    };
  }

  mesh(id, points, triangles, columns = [], more = {}) {
    const wide = points.length > 65535;
    const flat = (wide ? Uint32Array : Uint16Array).from(triangles.flat());
    return {
      ...this.cloud(id, points, columns, more),
      type: "mesh",
      triangles: { at: this.put(flat), count: triangles.length, bits: wide ? 32 : 16 },
    };
  }

  /** The page with its data. */
  page(template, json) {
    const marker = "<!-- velum:data -->\n";
    const block = Buffer.concat(this.parts).toString("base64");
    const text = JSON.stringify(json).replaceAll("<", "\\u003c");
    return template.replace(
      marker,
      () =>
        `<script id="velum-report" type="application/json">${text}</script>\n<script id="velum-data" type="text/plain">${block}</script>\n`,
    );
  }
}

export function histogram(value, name, unit, values, better) {
  const lo = Math.min(...values);
  const hi = Math.max(...values);
  const counts = new Array(64).fill(0);
  for (const x of values) counts[Math.min(63, Math.floor(((x - lo) / (hi - lo || 1)) * 64))] += 1;
  return { value, name, unit, lo, hi, counts, ...(better && { better }) };
}

/** Numbers that are the same every time (mulberry32). */
export function random(seed) {
  let state = seed >>> 0;
  const uniform = () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
  const normal = () => Math.sqrt(-2 * Math.log(1 - uniform())) * Math.cos(2 * Math.PI * uniform());
  return { uniform, normal };
}
