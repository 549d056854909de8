// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Which point is under the cursor. All drawn points are looked at, in double precision and without an
// index: half a million take some milliseconds.
import * as THREE from "three";

const kReach = 12; // pixels around the cursor in which a point can be picked
const kFlush = 0.005; // of the distance: a point this little behind a surface lies on it

/**
 * The drawn point under the cursor: of those whose dot covers it the foremost, which is the one that is
 * seen there; else the one nearest to the ray, within a few pixels. Surfaces hide what is behind them
 * and give their vertex nearest to where the ray meets them. `x`, `y` are pixels of the view. Returns
 * { layer, index } or null.
 */
export function pick(layers, camera, x, y, width, height) {
  const visible = layers.filter((layer) => layer.visible);
  const hit = nearestSurface(visible, camera, x, y, width, height);
  const limit = hit ? hit.depth * (1 + kFlush) : Infinity;
  let best = null;
  for (const layer of visible) {
    if (layer.value.isMesh()) continue;
    best = nearestOf(layer, camera, x, y, width, height, limit, best);
  }
  if (best && (best.covers || !hit)) return { layer: best.layer, index: best.index };
  return hit && { layer: hit.layer, index: hit.index };
}

function nearestOf(layer, camera, x, y, width, height, limit, best) {
  const matrix = new THREE.Matrix4()
    .multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse)
    .multiply(layer.object.matrix).elements;
  const local = layer.value.local();
  const radius = layer.size / 2;
  for (let i = 0, p = 0; p < local.length; ++i, p += 3) {
    const a = local[p],
      b = local[p + 1],
      c = local[p + 2];
    const w = matrix[3] * a + matrix[7] * b + matrix[11] * c + matrix[15];
    if (w <= camera.near || w > limit) continue;
    const dx =
      ((matrix[0] * a + matrix[4] * b + matrix[8] * c + matrix[12]) / w + 1) * 0.5 * width - x;
    if (dx > kReach || dx < -kReach) continue;
    const dy =
      (1 - (matrix[1] * a + matrix[5] * b + matrix[9] * c + matrix[13]) / w) * 0.5 * height - y;
    const off = Math.hypot(dx, dy);
    if (off > kReach) continue;
    const covers = off <= radius;
    if (best && !better(covers, off, w, best)) continue;
    if (layer.isShown(i)) best = { layer, index: i, covers, off, depth: w };
  }
  return best;
}

const better = (covers, off, depth, best) =>
  covers !== best.covers ? covers : covers ? depth < best.depth : off < best.off;

function nearestSurface(layers, camera, x, y, width, height) {
  const caster = new THREE.Raycaster();
  caster.setFromCamera(new THREE.Vector2((2 * x) / width - 1, 1 - (2 * y) / height), camera);
  const view = new THREE.Vector3();
  let nearest = null;
  for (const layer of layers) {
    if (!layer.value.isMesh()) continue;
    for (const hit of caster.intersectObject(layer.object, false)) {
      const depth = -view.copy(hit.point).applyMatrix4(camera.matrixWorldInverse).z;
      if (nearest && depth >= nearest.depth) break;
      const index = nearestCorner(layer, hit);
      if (!layer.isShown(index)) continue;
      nearest = { layer, index, depth };
      break;
    }
  }
  return nearest;
}

function nearestCorner(layer, hit) {
  const local = layer.value.local();
  const at = layer.object.worldToLocal(hit.point.clone());
  const off = (i) =>
    Math.hypot(local[3 * i] - at.x, local[3 * i + 1] - at.y, local[3 * i + 2] - at.z);
  return [hit.face.a, hit.face.b, hit.face.c].sort((i, j) => off(i) - off(j))[0];
}
