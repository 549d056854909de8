// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// The page of a study.
import { shapes } from "../data/report.js";
import { button, copyButton, download, h } from "../dom.js";
import { integer } from "../format.js";
import { frame, stagesSection } from "../frame.js";
import { comparisonSection } from "./comparison.js";
import { distributionsSection } from "./distributions.js";
import { Study } from "./model.js";
import { scatterSection } from "./scatter.js";
import { sideBySide } from "./side_by_side.js";
import { tableSection } from "./table.js";

export function studyPage(report) {
  const study = new Study(report);
  const cells = study.variants.reduce((sum, variant) => sum + variant.runs.length, 0);
  const failed = study.variants.reduce(
    (sum, variant) => sum + variant.runs.filter((run) => run.status !== "ok").length,
    0,
  );
  const measured = study.names.length > 0;
  return frame({
    kicker: "Velum \u00b7 study",
    title: report.title || study.title || study.graph,
    version: report.velum,
    facts: [
      ["variants", integer(study.variants.length)],
      study.hasRuns && ["cells", integer(cells)],
      study.hasRuns && [
        "failed cells",
        failed ? h("span", { class: "status failed" }, integer(failed)) : "none",
      ],
      ...study.axes.map((axis) => [
        axis.name || "axis",
        axis.values.length > 6 ? `${axis.values.length} values` : axis.values.join(", "),
      ]),
    ],
    banner: banner(study, report.told),
    sections: [
      [
        "table",
        "Variants",
        tableSection(study, report.csv && (() => download("study.csv", report.csv, "text/csv"))),
      ],
      ["comparison", "Comparison", measured && comparisonSection(study)],
      ["scatter", "One measure against another", study.names.length > 1 && scatterSection(study)],
      ["view", "Side by side", viewsOf(report, study)],
      ["histograms", "Distributions", distributionsSection(report, study)],
      ["stages", "Stages: references and licences", stagesSection(report.stages)],
      ["again", "Run it again", again(study, report)],
    ],
  });
}

function viewsOf(report, study) {
  const views = sideBySide(shapes(report), study);
  const { variants, of } = report.views_of ?? {};
  return (
    views && [
      views,
      variants < of &&
        h(
          "p",
          { class: "hint" },
          `This page holds the surfaces of ${variants} of ${of} variants; those of the others are in their cells' folders.`,
        ),
    ]
  );
}

function banner(study, told) {
  const several = new Set(study.variants.map((variant) => variant.data)).size > 1;
  const some = told && told.variants < told.of;
  if (!several && !some) return null;
  return h(
    "div",
    { class: "banners" },
    some &&
      h(
        "p",
        { class: "banner warning" },
        `This page has the best ${integer(told.variants)} of ${integer(told.of)} variants by their rank in the first measure; study.csv beside it has all.`,
      ),
    several &&
      h(
        "p",
        { class: "banner warning" },
        "Not all variants had the same data. Ranks and differences count only within a group of variants that had; the table's column \u201cdata\u201d numbers the groups.",
      ),
  );
}

function again(study, report) {
  const command = `velum study ${/\s/.test(study.graph) ? JSON.stringify(study.graph) : study.graph}`;
  return [
    h(
      "div",
      { class: "command" },
      h("pre", {}, h("code", {}, command)),
      copyButton("Copy", () => command),
    ),
    h(
      "p",
      { class: "hint" },
      "The record of each cell is cells/VARIANT/REPEAT/run.json beside this report; velum rerun runs one alone.",
    ),
    report.csv &&
      h(
        "div",
        { class: "buttons" },
        button("Download study.csv", () => download("study.csv", report.csv, "text/csv")),
        button("Download study.json", () =>
          download("study.json", JSON.stringify(report.study, null, 1), "application/json"),
        ),
      ),
  ];
}
