// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A study as the command would report it: four meshers, three radii, six repeats; some cells fail.
import { Packer, random } from "./packer.mjs";
import { sailGrid } from "./shapes.mjs";

const kMeshers = ["delaunay_projected", "greedy_projection", "poisson", "bspline"];
const kRadii = ["80 mm", "120 mm", "200 mm"];
const kMeasures = {
  "error.rms": { unit: "m", better: "lower" },
  "quality.area": { unit: "m^2", better: "neither" },
  "mesh.seconds": { unit: "s", better: "lower" },
  "score.iou": { unit: "", better: "higher" },
};

const faults = {
  "poisson 80 mm 2": ["crashed", "the process was ended by signal 11 (segmentation fault)"],
  "poisson 80 mm 5": ["timed_out", "longer than 60 s"],
  "bspline 200 mm 3": [
    "failed",
    "E1001 mesh (meshing.bspline): the fit is singular, <refinement> 3 is too fine",
  ],
};

function summaryOf(values) {
  const sorted = [...values].sort((a, b) => a - b);
  const mean = values.reduce((a, b) => a + b, 0) / values.length;
  const sd = Math.sqrt(
    values.reduce((sum, x) => sum + (x - mean) ** 2, 0) / Math.max(1, values.length - 1),
  );
  const at = (share) => sorted[0] + (sorted.at(-1) - sorted[0]) * share;
  return {
    count: values.length,
    mean,
    sd,
    median: at(0.5),
    q1: at(0.25),
    q3: at(0.75),
    ci95: [mean - (2 * sd) / Math.sqrt(values.length), mean + (2 * sd) / Math.sqrt(values.length)],
    rank: null,
  };
}

function runOf(mesher, m, radius, r, repeat, rng) {
  const fault =
    faults[`${mesher} ${radius} ${repeat}`] ??
    (mesher === "greedy_projection" && radius === "200 mm"
      ? ["invalid", "E0206 study.toml:31:3 radius is 0.2; it must be below 0.15"]
      : null);
  if (fault) return { repeat, seed: repeat, status: fault[0], message: fault[1], measures: {} };
  const measures = {
    "error.rms": (0.0008 + 0.0004 * m + 0.0003 * Math.abs(r - 1)) * (1 + 0.08 * rng.normal()),
    "quality.area": 1.79 + 0.01 * rng.normal(),
    "mesh.seconds": (0.9 / (m + 1) + 0.05 * r) * (1 + 0.1 * Math.abs(rng.normal())),
    "score.iou": 0.95 - 0.02 * m + 0.005 * rng.normal(),
  };
  return { repeat, seed: repeat, status: "ok", measures };
}

export function sampleStudy({ repeats = 6, size = 40 } = {}) {
  const packer = new Packer();
  const rng = random(11);
  const variants = [];
  const values = [];
  kMeshers.forEach((mesher, m) =>
    kRadii.forEach((radius, r) => {
      const id = `v${String(variants.length + 1).padStart(2, "0")}`;
      const runs = Array.from({ length: repeats }, (_, k) =>
        runOf(mesher, m, radius, r, k + 1, rng),
      );
      const good = runs.filter((run) => run.status === "ok");
      const bad = runs.find((run) => run.status !== "ok");
      const summary = Object.fromEntries(
        Object.keys(kMeasures)
          .filter(() => good.length)
          .map((name) => [name, summaryOf(good.map((run) => run.measures[name]))]),
      );
      variants.push({
        id,
        axes: { mesh: mesher, radius },
        status: bad?.status ?? "ok",
        message: bad?.message ?? "",
        success: good.length / runs.length,
        data: 0,
        runs,
        summary,
      });
      if (good.length === 0) return;
      const grid = sailGrid(size, size, () => 0.0006 * (m + 1) * rng.normal());
      values.push({
        ...packer.mesh(`${id}/mesh.mesh`, grid.points, grid.triangles, [
          packer.numbers(
            "deviation",
            "m",
            grid.points.map(() => 0.001 * (m + 1) * rng.normal()),
          ),
        ]),
        variant: id,
      });
    }),
  );
  for (const [name, { better }] of Object.entries(kMeasures)) rank(variants, name, better);
  const rows = variants.flatMap((variant) =>
    variant.runs.map((run) =>
      [
        variant.id,
        run.repeat,
        run.seed,
        run.status,
        run.message ? `"${run.message}"` : "",
        variant.axes.mesh,
        variant.axes.radius,
        ...Object.keys(kMeasures).map((name) => run.measures[name] ?? ""),
      ].join(","),
    ),
  );
  const csv = `variant,repeat,seed,status,message,mesh,radius,${Object.entries(kMeasures)
    .map(([name, { unit }]) => (unit ? `${name} [${unit}]` : name))
    .join(",")}\n${rows.join("\n")}\n`;
  const json = {
    format: 1,
    kind: "study",
    velum: "0.1.0",
    title: "Meshers on a sail",
    csv,
    values,
    histograms: [],
    stages: Object.fromEntries(
      kMeshers.map((name) => [
        `meshing.${name}`,
        {
          id: `meshing.${name}`,
          version: "1",
          summary: `Meshes by ${name}.`,
          parameters: [],
          determinism: "bitwise",
          references: [],
          licence: "MIT",
        },
      ]),
    ),
    study: {
      velum: "0.1.0",
      graph: "meshing.toml",
      title: "Meshers on a sail",
      axes: [
        { name: "mesh", values: kMeshers },
        { name: "radius", values: kRadii },
      ],
      measures: kMeasures,
      variants,
    },
  };
  return { packer, json };
}

function rank(variants, name, better) {
  if (better === "neither") return;
  const whole = variants.filter((variant) => variant.success === 1);
  const sign = better === "lower" ? 1 : -1;
  whole
    .sort((a, b) => sign * (a.summary[name].mean - b.summary[name].mean))
    .forEach((variant, i) => {
      variant.summary[name].rank = i + 1;
      if (variant.id !== "v01")
        variant.summary[name].difference = {
          reference: "v01",
          pairs: 6,
          mean: variant.summary[name].mean - whole[0].summary[name].mean,
          p: i < 3 ? 0.2 : 0.03125,
        };
    });
  variants.sort((a, b) => (a.id < b.id ? -1 : 1));
}
