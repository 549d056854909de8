// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import * as THREE from "three";

const kTurn = Math.PI / 36;
const kZoom = 1.15;

/** Towards the camera. */
export const directions = {
  "+x": [1, 0, 0.0001],
  "\u2212x": [-1, 0, 0.0001],
  "+y": [0, 1, 0.0001],
  "\u2212y": [0, -1, 0.0001],
  top: [0, -0.0001, 1],
  oblique: [1, -1.2, 0.7],
};

export const keyHelp =
  "Arrows turn, with Shift they move; plus and minus zoom; 0 shows all; 1 to 6 look from +x, \u2212x, +y, \u2212y, above, obliquely; Enter picks at the centre; Delete takes the last pick back.";

/** What the keyboard does in a view. `view.onDelete` takes the last pick back. */
export function bindKeys(view) {
  view.canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const act = actionOf(view, event);
    if (!act) return;
    event.preventDefault();
    act();
  });
}

function actionOf(view, event) {
  const arrows = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  if (event.key in arrows) {
    const [x, y] = arrows[event.key];
    return () => (event.shiftKey ? move(view, -x, -y) : turn(view, x * kTurn, y * kTurn));
  }
  const digit = "123456".indexOf(event.key);
  if (digit >= 0) return () => view.fit(Object.values(directions)[digit]);
  return {
    "+": () => zoom(view, 1 / kZoom),
    "=": () => zoom(view, 1 / kZoom),
    "-": () => zoom(view, kZoom),
    0: () => view.fit(),
    Home: () => view.fit(),
    Enter: () => view.pickAt(view.element.clientWidth / 2, view.element.clientHeight / 2),
    Delete: () => view.onDelete?.(),
    Backspace: () => view.onDelete?.(),
  }[event.key];
}

function turn(view, azimuth, polar) {
  const off = view.camera.position.clone().sub(view.controls.target);
  const upright = new THREE.Quaternion().setFromUnitVectors(
    view.camera.up,
    new THREE.Vector3(0, 1, 0),
  );
  const sphere = new THREE.Spherical().setFromVector3(off.applyQuaternion(upright));
  sphere.theta -= azimuth;
  sphere.phi = THREE.MathUtils.clamp(sphere.phi + polar, 1e-3, Math.PI - 1e-3);
  off.setFromSpherical(sphere).applyQuaternion(upright.invert());
  view.camera.position.copy(view.controls.target).add(off);
  view.controls.update();
}

function zoom(view, factor) {
  view.camera.position.sub(view.controls.target).multiplyScalar(factor).add(view.controls.target);
  view.controls.update();
}

function move(view, x, y) {
  const step = view.camera.position.distanceTo(view.controls.target) * 0.05;
  const right = new THREE.Vector3()
    .setFromMatrixColumn(view.camera.matrixWorld, 0)
    .multiplyScalar(x * step);
  const up = new THREE.Vector3()
    .setFromMatrixColumn(view.camera.matrixWorld, 1)
    .multiplyScalar(-y * step);
  view.camera.position.add(right).add(up);
  view.controls.target.add(right).add(up);
  view.controls.update();
}
