// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// The page of one run.
import { shapes } from "../data/report.js";
import { h } from "../dom.js";
import { bytes, integer, moment, seconds } from "../format.js";
import { frame, stagesSection } from "../frame.js";
import { drawGraph } from "../graph/draw.js";
import { histogramSection } from "../plots/histograms.js";
import { historiesOf, historyFigures } from "../plots/history.js";
import { sailSection } from "../sails/section.js";
import { Explorer } from "../view3d/explorer.js";
import { withGraphics } from "../view3d/graphics.js";
import { againSection } from "./again.js";
import { filesSection } from "./files.js";
import { firstShown } from "./first.js";
import { nodesSection, openNode } from "./nodes.js";
import { banner } from "./banner.js";
import { tablesSection } from "./tables.js";

export function runPage(report) {
  const { run } = report;
  const histories = historiesOf(report.values);
  return frame({
    kicker: "Velum \u00b7 run",
    title: report.title || run.graph.title || run.graph.path,
    version: report.velum,
    facts: factsOf(run),
    banner: banner(run),
    sections: [
      ["graph", "Graph", drawGraph(run, openNode)],
      ["view", "Clouds and meshes", viewSection(report, histories)],
      ["sails", "Sails", sailSection(report)],
      [
        "registration",
        "Registration",
        histories.length > 0 &&
          h("div", { class: "multiples wide" }, histories.flatMap(historyFigures)),
      ],
      ["histograms", "Distributions", histogramSection(report.histograms)],
      ["nodes", "Nodes: parameters and measures", nodesSection(run, report.stages)],
      ["tables", "Tables", tablesSection(report)],
      ["files", "Files", filesSection(run)],
      ["stages", "Stages: references and licences", stagesSection(report.stages)],
      ["again", "Run it again", againSection(run)],
    ],
  });
}

function factsOf(run) {
  return [
    ["status", h("span", { class: `status ${run.status}` }, run.status)],
    ["time", seconds(run.seconds)],
    run.cpu_seconds !== null && ["processor time", seconds(run.cpu_seconds)],
    run.peak_bytes && ["memory", bytes(run.peak_bytes)],
    ["nodes", integer(run.nodes.length)],
    ["threads", run.threads],
    ["seed", run.seed],
    ["started", moment(run.started)],
    run.machine && [
      "machine",
      `${run.machine.cpu}, ${run.machine.cores} cores, ${bytes(run.machine.memory_bytes)}, ${run.machine.os}`,
    ],
  ];
}

function viewSection(report, histories) {
  const values = shapes(report);
  if (values.length === 0) return null;
  return withGraphics(() => {
    const explorer = new Explorer(
      values,
      report.run.nodes,
      firstShown(values, report.run),
      histories.map(pathOf).filter(Boolean),
    );
    window.velum = { view: explorer.view, explorer }; // for tests and the curious
    return explorer.element;
  });
}

/** The barycentre's way in a history. */
function pathOf(value) {
  const names = value.rows.columns.map((column) => column.name);
  const at = ["x", "y", "z"].map((name) => names.indexOf(name));
  const points = value.rows.rows
    .map((row) => at.map((i) => row[i]))
    .filter((point) => point.every(Number.isFinite));
  return at.every((i) => i >= 0) && points.length > 1 ? points : null;
}
