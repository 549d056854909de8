// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
//
// node test/sample.mjs TEMPLATE run|failed|study OUT [POINTS]: a report with made-up data, to look at.
import { readFile, writeFile } from "node:fs/promises";
import { sampleRun } from "./sample_run.mjs";
import { sampleStudy } from "./sample_study.mjs";

const [template, kind, out, points] = process.argv.slice(2);
const { packer, json } =
  kind === "study"
    ? sampleStudy()
    : sampleRun({ failed: kind === "failed", points: Number(points ?? 4000) });
await writeFile(out, packer.page(await readFile(template, "utf8"), json));
