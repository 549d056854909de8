// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// What a run's view shows at first: results rather than what they were made of.
import { telling } from "../view3d/telling.js";

/** Ids of the values to show, with the key of their colouring. */
export function firstShown(values, run) {
  const stage = new Map(run.nodes.map((node) => [node.name, node.use]));
  const made = values.filter((value) => stage.get(value.node) !== "devices.truth");
  const meshes = made.filter((value) => value.isMesh());
  if (meshes.length) {
    // Meshes that a later mesh was made of would only cover it.
    const used = new Set(
      run.nodes
        .filter((node) => Object.values(node.out ?? {}).some((out) => out?.type === "mesh"))
        .flatMap((node) =>
          Object.values(node.in ?? {})
            .flat()
            .map((wire) => wire?.from),
        ),
    );
    const last = meshes.filter((mesh) => !used.has(mesh.id));
    return new Map((last.length ? last : meshes).slice(0, 4).map((mesh) => [mesh.id, "height"]));
  }
  const rich = made.filter((value) => telling(value));
  const last = (rich.length ? rich : made.length ? made : values).at(-1);
  return new Map([[last.id, telling(last) ?? "height"]]);
}
