// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import * as THREE from "three";

/** A grid on the ground under what is visible, with a spacing of 1, 2 or 5 times a power of ten. */
export class Grid {
  constructor(scene) {
    this.lines = new THREE.LineSegments(
      new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({ color: 0x7f8c99, transparent: true, opacity: 0.45 }),
    );
    this.lines.frustumCulled = false;
    this.spacing = 1;
    scene.add(this.lines);
  }

  place(box, base) {
    const size = box.getSize(new THREE.Vector3());
    const spacing = roundStep(Math.max(size.x, size.y, size.z) / 8);
    // On whole multiples of the spacing in the world.
    const first = [box.min.x, box.min.y].map(
      (x, axis) => Math.floor((x + base[axis]) / spacing - 0.5) * spacing - base[axis],
    );
    const last = [box.max.x, box.max.y].map(
      (x, axis) => Math.ceil((x + base[axis]) / spacing + 0.5) * spacing - base[axis],
    );
    const z = box.min.z;
    const points = [];
    for (let x = first[0]; x <= last[0] + spacing / 2; x += spacing)
      points.push(x, first[1], z, x, last[1], z);
    for (let y = first[1]; y <= last[1] + spacing / 2; y += spacing)
      points.push(first[0], y, z, last[0], y, z);
    this.lines.geometry.dispose();
    this.lines.geometry = new THREE.BufferGeometry();
    this.lines.geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    this.spacing = spacing;
    this.onSpacing?.(spacing);
  }

  setVisible(visible) {
    this.lines.visible = visible;
  }
}

/** The nearest 1, 2 or 5 times a power of ten. */
export function roundStep(x) {
  const power = 10 ** Math.floor(Math.log10(Math.max(x, 1e-9)));
  const lead = x / power;
  return (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10) * power;
}
