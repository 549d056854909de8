// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A run as the command would report it: two scans, registered, segmented, smoothed, meshed, measured.
import { histogram, Packer, random } from "./packer.mjs";
import { sailGrid, sectionColumns, sectionRows, tunnel } from "./shapes.mjs";

const wire = (from, type, more) => ({ from, type, hash: "0011223344556677", ...more });
const measure = (value, unit, better = "lower") => ({ value, unit, better });

function node(name, use, inputs, more = {}) {
  return {
    name,
    use,
    version: "1",
    plugin_hash: "8a8dcbed3fdec9054facd64c76010ad1",
    status: "ok",
    seconds: 0.4,
    cpu_seconds: null,
    peak_bytes: null,
    parameters: {},
    in: inputs,
    out: {},
    measures: {},
    warnings: [],
    ...more,
  };
}

function nodesOf(failed) {
  const cloud = (from) => ({ cloud: wire(`${from}.cloud`, "cloud", { points: 4000 }) });
  const last = failed ? { status: "skipped", seconds: null } : {};
  return [
    node(
      "scan_a",
      "devices.simulator",
      {},
      {
        seconds: 1.32,
        peak_bytes: 61538304,
        parameters: { scene: "scenes/wind_tunnel.toml", scanner: "gennaker", beam_step: 0.00436 },
      },
    ),
    node("scan_b", "devices.simulator", {}, { status: "cached", seconds: 0.004 }),
    node(
      "register",
      "registration.icp",
      { source: wire("scan_b.cloud", "cloud"), target: wire("scan_a.cloud", "cloud") },
      {
        seconds: 2.7,
        parameters: { metric: "point_to_plane", max_distance: 0.1, iterations: 25 },
        measures: {
          fitness: measure(7.1e-6, "m^2"),
          rmse: measure(0.00266, "m"),
          overlap: measure(0.62, "", "higher"),
          deviation_rotation: measure(1.2e-5, "rad"),
          iterations: measure(12, "", "neither"),
        },
        out: {
          transform: {
            type: "transform",
            hash: "aa",
            source: "source",
            target: "target",
            matrix: [
              [1, 0, 0, 0.1],
              [0, 1, 0, 0],
              [0, 0, 1, 0],
              [0, 0, 0, 1],
            ],
          },
        },
      },
    ),
    node("scene", "filtering.merge", {
      clouds: [wire("scan_a.cloud", "cloud"), wire("register.cloud", "cloud")],
    }),
    node("normals", "features.normals", cloud("scene"), {
      parameters: { neighbours: 50, radius: null },
    }),
    node("parts", "segmentation.region_growing", cloud("normals"), {
      warnings: ["12 points lie in no part <b>& stay</b>"],
      parameters: { smoothness: 0.122, min_size: 500 },
    }),
    node("sail", "filtering.select_cluster", { clusters: wire("parts.clusters", "clusters") }),
    node("smooth", "resampling.mls", cloud("sail"), { seconds: 0.9 }),
    node("moved", "analysis.displacement", {
      cloud: wire("smooth.cloud", "cloud"),
      reference: wire("sail.cloud", "cloud"),
    }),
    node(
      "mesh",
      "meshing.delaunay_projected",
      cloud("smooth"),
      failed
        ? {
            status: "failed",
            seconds: 0.2,
            error: {
              code: "E1001",
              node: "mesh",
              stage: "meshing.delaunay_projected",
              message: "all points lie on one line",
              where: "graph.toml:40:1",
              hint: "segment the sail first",
            },
          }
        : { seconds: 0.31 },
    ),
    node(
      "shape",
      "analysis.sail_shape",
      { mesh: wire("mesh.mesh", "mesh") },
      {
        ...last,
        measures: {
          luff: measure(2.18, "m", "neither"),
          leech: measure(2.11, "m", "neither"),
          foot: measure(1.31, "m", "neither"),
          area: measure(1.93, "m^2", "neither"),
        },
      },
    ),
    node("truth", "devices.truth", {}),
    node(
      "error",
      "analysis.mesh_to_reference",
      { mesh: wire("mesh.mesh", "mesh"), reference: wire("truth.mesh", "mesh") },
      { ...last, measures: { rms: measure(0.00067, "m"), hausdorff: measure(0.0146, "m") } },
    ),
    node("save", "io.write_mesh", { mesh: wire("mesh.mesh", "mesh") }, last),
  ];
}

const history = {
  columns: [
    ["iteration", ""],
    ["pairs", ""],
    ["error", "m^2"],
    ["relative_change", ""],
    ["rotation", "rad"],
    ["translation", "m"],
    ["x", "m"],
    ["y", "m"],
    ["z", "m"],
  ].map(([name, unit]) => ({ name, unit })),
  rows: Array.from({ length: 12 }, (_, i) => [
    i + 1,
    3800 - 10 * i,
    7e-6 + 0.004 * Math.exp(-0.9 * i),
    Math.exp(-0.9 * i),
    0.08 * Math.exp(-0.8 * i),
    0.2 * Math.exp(-0.8 * i),
    0.3 * Math.exp(-0.7 * i),
    2.6 - 0.2 * Math.exp(-0.5 * i),
    0.05 * Math.exp(-i),
  ]),
};

/** `points` of the scene; `failed` ends the run at its mesher. Returns { packer, json, known }. */
export function sampleRun({ points = 4000, failed = false } = {}) {
  const packer = new Packer();
  const rng = random(7);
  const scene = tunnel(points, rng);
  const sensors = [
    { position: [0, 0, 0], name: "gennaker" },
    { position: [1.2, 6.1, 0.05], name: "mainsail" },
  ];
  const label = packer.labels("label", scene.labels);
  const cluster = packer.labels(
    "cluster",
    scene.labels.map((x) => (x === 3 ? -1 : [1, 2, 10].indexOf(x))),
    ["floor", "wall", "sail"],
  );
  const positions = packer.cloud("scene.cloud", scene.points, [label], { sensors });
  const raw = sailGrid(60, 80, () => 0.004 * rng.normal());
  const smooth = sailGrid(60, 80, () => 0.0006 * rng.normal());
  const truth = sailGrid(90, 120, () => 0);
  const displacement = raw.points.map((p, i) =>
    Math.hypot(...p.map((x, axis) => x - smooth.points[i][axis])),
  );
  const deviation = smooth.points.map((_, i) => (i % 97 ? 0.0006 * rng.normal() : null));
  const moved = packer.numbers("displacement", "m", displacement);
  const values = [
    packer.cloud("scan_a.cloud", scene.points.slice(0, points / 2), [], {
      sensors: sensors.slice(0, 1),
      origin: [100000, 200000, 0],
    }),
    positions,
    {
      ...positions,
      id: "parts.clusters",
      node: "parts",
      output: "clusters",
      type: "clusters",
      columns: [cluster],
    },
    packer.cloud(
      "sail.cloud",
      raw.points,
      [
        packer.numbers(
          "curvature",
          "",
          raw.points.map((p) => 0.01 + 0.005 * p[2]),
        ),
      ],
      { sensors },
    ),
    packer.cloud(
      "moved.cloud",
      smooth.points,
      [
        moved,
        packer.labels(
          "grade",
          displacement.map((d) => (d < 0.004 ? 0 : d < 0.009 ? 1 : 2)),
          ["good", "fair", "bad"],
        ),
      ],
      { sensors },
    ),
    ...(failed
      ? []
      : [
          packer.mesh(
            "mesh.mesh",
            smooth.points,
            smooth.triangles,
            [packer.numbers("deviation", "m", deviation)],
            { sensors },
          ),
          {
            id: "shape.table",
            node: "shape",
            output: "table",
            type: "table",
            count: 3,
            shown: 3,
            rows: { columns: sectionColumns, rows: sectionRows([0.25, 0.5, 0.75], 0.01) },
          },
        ]),
    packer.mesh("truth.mesh", truth.points, truth.triangles),
    {
      id: "truth.table",
      node: "truth",
      output: "table",
      type: "table",
      count: 3,
      shown: 3,
      rows: { columns: sectionColumns, rows: sectionRows([0.25, 0.5, 0.75]) },
    },
    {
      id: "register.table",
      node: "register",
      output: "table",
      type: "table",
      count: 12,
      shown: 12,
      rows: history,
    },
    {
      id: "register.transform",
      node: "register",
      output: "transform",
      type: "transform",
      count: 1,
      shown: 1,
      matrix: [1, 0, 0, 0.1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
    },
  ];
  const nodes = nodesOf(failed);
  const json = {
    format: 1,
    kind: "run",
    velum: "0.1.0",
    title: "A sail in the wind tunnel",
    values,
    stages: Object.fromEntries(
      nodes.map(({ use }) => [
        use,
        {
          id: use,
          version: "1",
          summary: `What ${use} does, in a sentence.`,
          parameters: [
            {
              name: "max_distance",
              type: "length",
              unit: "m",
              doc: "pairs farther apart do not count",
            },
            { name: "smoothness", type: "angle", unit: "rad" },
          ],
          determinism: "bitwise",
          references: ["Besl, McKay: A method for registration of 3-D shapes. PAMI 1992"],
          licence: use.includes("delaunay") ? "GPL-3.0-or-later" : "MIT",
        },
      ]),
    ),
    run: {
      velum: "0.1.0",
      graph: {
        path: "wind_tunnel.toml",
        title: "A sail in the wind tunnel",
        hash: "db5401f52513b76a",
        resolved: 'format = 1\n\n[node.scan_a]\nuse = "devices.simulator"\n',
      },
      status: failed ? "failed" : "ok",
      started: "2026-03-01T12:00:00Z",
      seconds: 6.1,
      cpu_seconds: 9.4,
      peak_bytes: 215384064,
      threads: 2,
      seed: 1,
      machine: {
        cpu: "a processor",
        cores: 2,
        instruction_set: "x86-64 avx2",
        os: "Debian GNU/Linux 12",
        kernel: "Linux 6",
        memory_bytes: 25276514304,
      },
      nodes,
      files: failed
        ? []
        : [
            {
              path: "sail.ply",
              node: "save",
              bytes: 467815,
              hash: "db5401f52513b76a1c1fb5d12ebc9504",
            },
          ],
      inputs: [
        { path: "scenes/wind_tunnel.toml", bytes: 3554, hash: "2a336310559c24c5eaeae01e139a5d76" },
      ],
      error: failed ? nodes.find((one) => one.status === "failed").error : null,
    },
    histograms: [
      histogram("moved.cloud", "displacement", "m", displacement, "lower"),
      histogram(
        "mesh.mesh",
        "deviation",
        "m",
        deviation.filter((x) => x !== null),
      ),
      histogram(
        "register",
        "distance before",
        "m",
        Array.from({ length: 2000 }, () => Math.abs(0.06 + 0.03 * rng.normal())),
      ),
      histogram(
        "register",
        "distance after",
        "m",
        Array.from({ length: 2000 }, () => Math.abs(0.004 * rng.normal())),
      ),
      histogram(
        "mesh.mesh",
        "triangle angle",
        "rad",
        Array.from({ length: 3000 }, () => 1.05 + 0.25 * rng.normal()),
      ),
      histogram(
        "mesh.mesh",
        "edge ratio",
        "",
        Array.from({ length: 3000 }, () => 1.3 + 0.3 * Math.abs(rng.normal())),
      ),
      histogram(
        "sail.cloud",
        "curvature",
        "",
        raw.points.map((p) => 0.01 + 0.005 * p[2]),
      ),
    ],
  };
  return { packer, json };
}
