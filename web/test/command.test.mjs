// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A report that the command makes of a real run: a file of a curved cloud, read, meshed and measured.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { Browser, drawn, quiet } from "./browser.mjs";
import { sailGrid } from "./shapes.mjs";

const command = process.env.VELUM_COMMAND ?? "";
const stages = [
  "io/read_cloud",
  "filtering/remove_points",
  "meshing/delaunay_projected",
  "analysis/mesh_quality",
];
const plugins = process.env.VELUM_PLUGIN_PATH ?? "";
const missing =
  !existsSync(command) || stages.some((stage) => !existsSync(join(plugins, `${stage}.so`)));
const skip = missing && "the command and its plugins are not built";

const graph = `format = 1
title = "A sail from a file"
units = "m"

[node.scan]
use = "io.read_cloud"
file = "sail.xyz"

[node.mesh]
use = "meshing.delaunay_projected"
in = "scan"

[node.quality]
use = "analysis.mesh_quality"
in = "mesh"
`;

let browser;
let points;
const velum = (...args) =>
  execFileSync(command, args, {
    cwd: browser.folder,
    encoding: "utf8",
    stdio: ["ignore", "pipe", "pipe"],
    env: {
      ...process.env,
      VELUM_REPORT_TEMPLATE: process.env.VELUM_PAGE,
      XDG_CACHE_HOME: browser.folder,
    },
  });

before(async () => {
  browser = await Browser.start();
  points = sailGrid(25, 30, () => 0).points;
  await writeFile(
    join(browser.folder, "sail.xyz"),
    points.map((p) => p.map((x) => x.toFixed(6)).join(" ")).join("\n"),
  );
  await writeFile(join(browser.folder, "sail.toml"), graph);
});
after(() => browser.close());

test("the command's report opens, draws, picks, and its TOML runs", { skip }, async () => {
  velum("run", "sail.toml", "--out", "out", "--report");
  const run = JSON.parse(await readFile(join(browser.folder, "out", "run.json"), "utf8"));
  const page = await browser.openFile(join(browser.folder, "out", "report.html"));
  assert.equal(await page.locator(".graph .node.ok").count(), run.nodes.length);
  assert.ok((await drawn(page, "#view canvas")).share > 0.05);
  assert.match(await page.locator("#node-quality").textContent(), /border_length/);
  assert.match(
    await page.locator("#stages").textContent(),
    /meshing\.delaunay_projected.*GPL-3\.0-or-later/,
  );

  // Every point is where the file has it, to the rounding that the page names.
  const shown = await page.evaluate(() => {
    const { value } = window.velum.explorer.entries.find(
      (entry) => entry.value.id === "scan.cloud",
    );
    return {
      step: value.step(),
      points: Array.from({ length: value.shown }, (_, i) => value.point(i)),
    };
  });
  assert.equal(shown.points.length, points.length);
  shown.points.forEach((p, i) =>
    p.forEach((x, axis) => assert.ok(Math.abs(x - points[i][axis]) <= shown.step[axis] / 2 + 2e-6)),
  );

  const toml = await page.evaluate(() => {
    const { explorer } = window.velum;
    const { value } = explorer.entries.find((entry) => entry.value.id === "scan.cloud");
    for (const index of [3, 14, 159]) explorer.picks.add(value, index);
    return document.querySelector(".picks pre.toml").textContent;
  });
  await writeFile(join(browser.folder, "cleaned.toml"), `${graph}\n${toml}\n`);
  velum("run", "cleaned.toml", "--out", "cleaned");
  const { nodes } = JSON.parse(await readFile(join(browser.folder, "cleaned", "run.json"), "utf8"));
  const cleaned = nodes.find((node) => node.name === "scan_cleaned");
  assert.equal(cleaned.measures.removed.value, 3);
  assert.equal(cleaned.out.cloud.points, points.length - 3);
  await quiet(page);
});

test("a run that failed has its report too", { skip }, async () => {
  await writeFile(
    join(browser.folder, "flat.xyz"),
    Array.from({ length: 50 }, (_, i) => `${i} 0 0`).join("\n"),
  );
  await writeFile(join(browser.folder, "flat.toml"), graph.replace("sail.xyz", "flat.xyz"));
  const { status } = spawnSync(command, ["run", "flat.toml", "--out", "flat", "--report"], {
    cwd: browser.folder,
    env: {
      ...process.env,
      VELUM_REPORT_TEMPLATE: process.env.VELUM_PAGE,
      XDG_CACHE_HOME: browser.folder,
    },
  });
  assert.equal(status, 1);
  const page = await browser.openFile(join(browser.folder, "flat", "report.html"));
  const { error } = JSON.parse(await readFile(join(browser.folder, "flat", "run.json"), "utf8"));
  assert.ok((await page.locator(".banner.failed").first().textContent()).includes(error.message));
  assert.equal(await page.locator(".graph .node.failed").count(), 1);
  await quiet(page);
});
