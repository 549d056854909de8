// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { Browser, drawn, nameless, quiet } from "./browser.mjs";
import { sampleStudy } from "./sample_study.mjs";

let browser;
let page;
before(async () => {
  browser = await Browser.start();
  page = await browser.open(sampleStudy());
});
after(() => browser.close());

const rows = () => page.locator(".study-table tbody tr");
const column = async (name) => {
  const heads = await page.locator(".study-table thead th").allTextContents();
  const at = heads.findIndex((text) => text.startsWith(name)) + 1;
  return page.locator(`.study-table tbody tr > :nth-child(${at})`).allTextContents();
};

test("it opens from disk with all variants, failed ones with their message", async () => {
  assert.equal(await rows().count(), 12);
  const texts = await rows().allTextContents();
  assert.match(texts[5], /invalid.*it must be below 0\.15/);
  assert.match(texts[6], /crashed.*segmentation fault/);
  assert.match(texts[11], /failed.*<refinement> 3/);
});

test("columns sort up and down, empty cells last", async () => {
  const head = page.locator(".study-table thead button", { hasText: "error.rms" });
  await head.click();
  const values = (await column("error.rms")).map((text) => parseFloat(text));
  assert.ok(Number.isNaN(values.at(-1)));
  const numbers = values.filter((x) => !Number.isNaN(x));
  assert.deepEqual(
    numbers,
    [...numbers].sort((a, b) => a - b),
  );
  await page.locator(".study-table thead button", { hasText: "error.rms" }).click();
  const down = (await column("error.rms"))
    .map((text) => parseFloat(text))
    .filter((x) => !Number.isNaN(x));
  assert.deepEqual(down, [...numbers].reverse());
  assert.equal(await page.locator('.study-table th[aria-sort="descending"]').count(), 1);
});

test("words and status filter, also cell by cell", async () => {
  await page.getByLabel("filter the table").fill("poisson 120");
  assert.equal(await rows().count(), 1);
  await page.getByLabel("filter the table").fill("");
  await page.getByLabel("rows", { exact: true }).selectOption("cells");
  assert.equal(await rows().count(), 72);
  await page.getByLabel("status", { exact: true }).selectOption("failed");
  assert.equal(await rows().count(), 9);
  await page.getByLabel("status", { exact: true }).selectOption("timed_out");
  assert.match(await rows().first().textContent(), /v075.*timed out.*longer than 60 s/);
  await page.getByLabel("status", { exact: true }).selectOption("");
  await page.getByLabel("rows", { exact: true }).selectOption("variants");
});

test("the CSV is downloaded as it was written", async () => {
  const [file] = await Promise.all([
    page.waitForEvent("download"),
    page.locator("#table").getByText("Download CSV").click(),
  ]);
  assert.equal(file.suggestedFilename(), "study.csv");
  assert.equal(await readFile(await file.path(), "utf8"), sampleStudy().json.csv);
});

test("bars, boxes and curves follow the measure", async () => {
  await page.locator("#comparison").scrollIntoViewIfNeeded();
  await page.waitForFunction(
    () =>
      document.querySelectorAll("#comparison .plot .xtitle, #comparison .plot .g-xtitle text")
        .length >= 3,
  );
  const titles = () => page.locator("#comparison .g-xtitle").allTextContents();
  assert.match((await titles())[0], /error\.rms \[mm\]/);
  await page.locator("#measure").selectOption("mesh.seconds");
  await page.waitForFunction(() =>
    /mesh\.seconds \[s\]/.test(document.querySelector("#comparison .g-xtitle")?.textContent),
  );
  assert.equal(await page.locator("#comparison .plot").first().locator(".bars .point").count(), 11);
});

test("the front follows the directions of the two measures", async () => {
  await page.locator("#scatter").scrollIntoViewIfNeeded();
  const said = page.locator("#scatter figure .hint");
  assert.match(await said.textContent(), /Pareto front .*delaunay_projected · 120 mm/);
  await page.locator("#scatter-y").selectOption("quality.area");
  assert.match(await said.textContent(), /no better direction/);
});

test("views are drawn and turn together until they are let go", async () => {
  assert.equal(await page.locator(".pane").count(), 4);
  await page.locator(".pane canvas").first().scrollIntoViewIfNeeded();
  assert.ok((await drawn(page, ".pane canvas")).share > 0.05);
  const positions = () =>
    page.evaluate(() =>
      window.velum.panes.map((view) =>
        view.camera.position.toArray().map((x) => Math.round(1e6 * x)),
      ),
    );
  const before = await positions();
  await page.locator(".pane canvas").first().focus();
  await page.keyboard.press("ArrowLeft");
  const turned = await positions();
  assert.notDeepEqual(turned[0], before[0]);
  for (const other of turned) assert.deepEqual(other, turned[0]);
  await page.getByLabel("cameras linked").uncheck();
  await page.locator(".pane canvas").first().focus();
  await page.keyboard.press("ArrowLeft");
  const loose = await positions();
  assert.notDeepEqual(loose[0], loose[1]);
  assert.deepEqual(loose[1], turned[1]);
});

test("a pane shows the variant that is chosen", async () => {
  const select = page.locator(".pane select").nth(1);
  await select.selectOption("v12");
  assert.equal(
    await page.evaluate(() => window.velum.panes[1].layers[0].value.id),
    "v12/mesh.mesh",
  );
});

test("all works without a mouse and has a name", async () => {
  assert.deepEqual(await nameless(page), []);
});

test("nothing was asked for and nothing complained", () => quiet(page));
