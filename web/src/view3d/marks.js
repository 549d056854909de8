// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import * as THREE from "three";
import { h } from "../dom.js";

/** Small labels that stay on points of the world: picks, scanners. */
export class Marks {
  constructor(parent, base) {
    this.base = base;
    this.parent = h("div", { class: "marks", "aria-hidden": "true" });
    parent.append(this.parent);
    this.marks = [];
  }

  /** `point` in the world [m]. Returns what takes the mark away again. */
  add(point, text, kind) {
    const element = h("span", { class: `mark ${kind}` }, h("b", {}, text));
    const mark = {
      at: new THREE.Vector3(...point.map((x, axis) => x - this.base[axis])),
      element,
      shown: true,
    };
    this.marks.push(mark);
    this.parent.append(element);
    return {
      remove: () => {
        this.marks = this.marks.filter((one) => one !== mark);
        element.remove();
      },
      show: (shown) => {
        mark.shown = shown;
      },
    };
  }

  place(camera, width, height) {
    const at = new THREE.Vector3();
    for (const mark of this.marks) {
      at.copy(mark.at).project(camera);
      const seen =
        mark.shown && at.z > -1 && at.z < 1 && Math.abs(at.x) < 1.05 && Math.abs(at.y) < 1.05;
      mark.element.hidden = !seen;
      if (seen)
        mark.element.style.transform = `translate(${(((at.x + 1) / 2) * width).toFixed(1)}px, ${(((1 - at.y) / 2) * height).toFixed(1)}px)`;
    }
  }
}
