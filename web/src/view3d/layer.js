// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// One value in the view: its geometry on the graphics card and how it is coloured.
import * as THREE from "three";
import { category, gradeColour, kNone, mapped, table } from "../colour.js";
import { kHeight, kLabel, kNumber, kPlain, meshShader, pointShader } from "./shaders.js";

const kNumberSteps = 65534;
const kMany = 40000;
const kTail = 0.01;
const kWorth = 1.6; // the full range is shown unless it is so many times that of 98 % of the points

export class Layer {
  /** `base`: the point of the world that the view has as its origin [m]. */
  constructor(value, base, index) {
    this.value = value;
    this.base = base;
    this.visible = true;
    this.opacity = 1;
    this.size = value.shown > 60000 ? 2 : 3;
    this.plain = category(index);
    this.map = "viridis";
    this.hidden = new Set();
    this.object = this.#build();
    this.object.matrixAutoUpdate = false;
    const corner = value.corner();
    this.object.matrix.makeTranslation(
      corner[0] - base[0],
      corner[1] - base[1],
      corner[2] - base[2],
    );
    this.object.matrixWorldNeedsUpdate = true;
    this.colourBy("plain");
  }

  #build() {
    const value = this.value;
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute("position", new THREE.BufferAttribute(value.local(), 3));
    const { lo, hi } = value.positions;
    this.geometry.boundingSphere = new THREE.Sphere();
    new THREE.Box3(
      new THREE.Vector3(),
      new THREE.Vector3(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]),
    ).getBoundingSphere(this.geometry.boundingSphere);
    this.uniforms = {
      source: { value: kPlain },
      affine: { value: new THREE.Vector2(1, 0) },
      plain: { value: new THREE.Vector3(...this.plain).divideScalar(255) },
      none: { value: new THREE.Vector3(...kNone).divideScalar(255) },
      opacity: { value: 1 },
      size: { value: this.size },
      table: { value: textureOf(table("viridis"), 256, THREE.LinearFilter) },
    };
    const shader = value.isMesh() ? meshShader : pointShader;
    this.material = new THREE.ShaderMaterial({
      ...shader,
      uniforms: this.uniforms,
      side: THREE.DoubleSide,
    });
    if (!value.isMesh()) {
      if (value.shown > kMany)
        this.geometry.setIndex(new THREE.BufferAttribute(shuffled(value.shown), 1));
      return new THREE.Points(this.geometry, this.material);
    }
    this.geometry.setIndex(new THREE.BufferAttribute(value.indices(), 1));
    this.geometry.computeVertexNormals();
    return new THREE.Mesh(this.geometry, this.material);
  }

  /** Draws only this share of a large cloud, evenly taken. */
  setShare(share) {
    if (!this.value.isMesh() && this.value.shown > kMany)
      this.geometry.setDrawRange(0, Math.max(kMany, Math.round(share * this.value.shown)));
  }

  /** Colours to choose from: [key, text]. */
  colourings() {
    return [
      ["plain", "one colour"],
      ["height", "height (z)"],
      ...this.value.columns.map((column) => [`column:${column.name}`, column.name]),
    ];
  }

  /** `key` as in colourings(). */
  colourBy(key) {
    this.key = key;
    this.column = key.startsWith("column:") ? this.value.column(key.slice(7)) : null;
    this.hidden.clear();
    if (key === "plain") this.uniforms.source.value = kPlain;
    else if (this.column?.kind === "label") this.#useLabels();
    else this.#useNumbers();
  }

  #useNumbers() {
    this.uniforms.source.value = this.column ? kNumber : kHeight;
    if (this.column) this.#setEntries(this.value.raw(this.column));
    this.map = this.#isSigned() ? "blue to red" : this.map === "blue to red" ? "viridis" : this.map;
    this.setTable(table(this.map), 256, THREE.LinearFilter);
    this.setRange(...this.goodRange());
    this.chosen = false;
  }

  /** A range that a person wants. */
  choose(lo, hi) {
    this.setRange(lo, hi);
    this.chosen = true;
  }

  /** Columns that are off to either side of zero. */
  #isSigned() {
    return (
      this.column &&
      this.column.lo < 0 &&
      this.column.hi > 0 &&
      /deviation|distance|signed|difference/.test(this.column.name)
    );
  }

  #useLabels() {
    const labels = this.value.labels(this.column);
    const rank = new Map(labels.map(({ label }, i) => [label, i]));
    const none = this.column.bits === 32 ? 0xffffffff : 0xffff;
    const raw = this.value.raw(this.column);
    const entries = new Float32Array(raw.length);
    for (let i = 0; i < raw.length; ++i) entries[i] = rank.get(raw[i] === none ? null : raw[i]);
    this.uniforms.source.value = kLabel;
    this.#setEntries(entries);
    this.#paintLabels();
  }

  #setEntries(entries) {
    this.geometry.setAttribute("entry", new THREE.BufferAttribute(entries, 1));
  }

  /** What the colour map spans when nothing else is asked: metres or the column's unit. */
  fullRange() {
    if (this.column) return [this.column.lo, this.column.hi];
    const [lo, hi] = this.value.bounds();
    return [lo[2], hi[2]];
  }

  /** The full range, without the few that would take most of it; about zero for signed columns. */
  goodRange() {
    if (!this.column) return this.fullRange();
    const full = this.fullRange();
    const inner = [kTail, 1 - kTail].map((share) => this.value.quantile(this.column, share));
    let [lo, hi] =
      full[1] - full[0] > kWorth * (inner[1] - inner[0]) && inner[1] > inner[0] ? inner : full;
    if (this.#isSigned()) hi = Math.max(-lo, hi);
    return [this.#isSigned() ? -hi : lo, hi];
  }

  setRange(lo, hi) {
    this.range = [lo, hi];
    const span = hi - lo || 1;
    if (this.column?.kind === "number") {
      const step = (this.column.hi - this.column.lo) / kNumberSteps;
      this.uniforms.affine.value.set(step / span, (this.column.lo - lo) / span);
    } else {
      this.uniforms.affine.value.set(1 / span, (this.value.corner()[2] - lo) / span);
    }
  }

  setMap(map) {
    this.map = map;
    if (this.isNumeric()) this.setTable(table(map), 256, THREE.LinearFilter);
  }

  isNumeric() {
    return this.key !== "plain" && this.column?.kind !== "label";
  }

  /** Shows or hides the points of one label. */
  toggleLabel(label, shown) {
    if (shown) this.hidden.delete(label);
    else this.hidden.add(label);
    this.#paintLabels();
  }

  #paintLabels() {
    const labels = this.value.labels(this.column);
    const width = Math.min(labels.length, 4096);
    const bytes = new Uint8Array(width * 4);
    for (let i = 0; i < width; ++i)
      bytes.set(
        [...labelColour(this.column, labels, i), this.hidden.has(labels[i].label) ? 0 : 255],
        4 * i,
      );
    this.setTable(bytes, width, THREE.NearestFilter);
  }

  setTable(bytes, width, filter) {
    this.uniforms.table.value.dispose();
    this.uniforms.table.value = textureOf(bytes, width, filter);
  }

  setPlain(rgb) {
    this.plain = rgb;
    this.uniforms.plain.value.set(...rgb).divideScalar(255);
  }

  setOpacity(opacity) {
    this.opacity = opacity;
    this.uniforms.opacity.value = opacity;
  }

  /** Thin lines along the triangles' edges. */
  setEdges(shown) {
    if (shown && !this.edges) {
      const lines = new THREE.WireframeGeometry(this.geometry);
      this.edges = new THREE.LineSegments(
        lines,
        new THREE.LineBasicMaterial({ color: 0x000000, transparent: true, opacity: 0.35 }),
      );
      this.material.polygonOffset = true;
      this.material.polygonOffsetFactor = 1;
      this.material.polygonOffsetUnits = 1;
      this.object.add(this.edges);
    }
    if (this.edges) this.edges.visible = shown;
  }

  /** Whether the i-th point is drawn: its label may be hidden. */
  isShown(index) {
    if (this.hidden.size === 0 || this.column?.kind !== "label") return true;
    return !this.hidden.has(this.value.entry(this.column, index));
  }

  /** Colour as drawn, as [r, g, b] of 255, of a number in the column's unit. */
  colourOf(number) {
    return mapped(this.map, (number - this.range[0]) / (this.range[1] - this.range[0] || 1));
  }

  setVisible(visible) {
    this.visible = visible;
    this.object.visible = visible;
  }

  dispose() {
    this.geometry.dispose();
    this.material.dispose();
    this.uniforms.table.value.dispose();
    this.edges?.geometry.dispose();
  }
}

/** The colour of the i-th of a column's labels: "none" is grey, grades are green to red. */
export function labelColour(column, labels, i) {
  if (labels[i].label === null) return kNone;
  return (column.name === "grade" && gradeColour(labels[i].label)) || category(i);
}

/** 0 to count - 1 in an order of which each beginning is spread evenly, the same every time. */
function shuffled(count) {
  const order = Uint32Array.from({ length: count }, (_, i) => i);
  let state = 1;
  for (let i = count - 1; i > 0; --i) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    const j = Math.floor((state / 4294967296) * (i + 1));
    [order[i], order[j]] = [order[j], order[i]];
  }
  return order;
}

function textureOf(bytes, width, filter) {
  const texture = new THREE.DataTexture(bytes, width, 1, THREE.RGBAFormat, THREE.UnsignedByteType);
  texture.minFilter = texture.magFilter = filter;
  texture.needsUpdate = true;
  return texture;
}
