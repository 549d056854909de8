// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import * as THREE from "three";

/** Every scanner of the visible values once, as a labelled mark. */
export class Scanners {
  constructor(view) {
    this.view = view;
    this.marks = [];
    this.shown = true;
  }

  /** Where the scanners of what is shown stood [m]. */
  positions() {
    return this.marks.map((mark) => mark.point);
  }

  refresh(values) {
    for (const mark of this.marks) mark.remove();
    const seen = new Set();
    this.marks = [];
    for (const value of values) {
      value.sensors.forEach((sensor, i) => {
        const name = sensor.name || `scanner ${i + 1}`;
        const key = `${name} ${sensor.position.map((x) => x.toFixed(3))}`;
        if (seen.has(key)) return;
        seen.add(key);
        const mark = this.view.marks.add(sensor.position, name, "scanner");
        mark.show(this.shown);
        this.marks.push({ ...mark, point: sensor.position });
      });
    }
    this.view.draw();
  }

  setVisible(shown) {
    this.shown = shown;
    for (const mark of this.marks) mark.show(shown);
    this.view.draw();
  }
}

/** A line through points of the world, such as the path of a barycentre. */
export function pathLine(view, points, colour) {
  const geometry = new THREE.BufferGeometry().setFromPoints(
    points.map((point) => view.relative(point)),
  );
  const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ color: colour }));
  line.frustumCulled = false;
  line.visible = false;
  view.addObject(line);
  return line;
}
