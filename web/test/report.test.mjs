// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Browser, drawn, quiet } from "./browser.mjs";
import { sampleRun } from "./sample_run.mjs";
import { sampleStudy } from "./sample_study.mjs";

let browser;
before(async () => { browser = await Browser.start(); });
after(() => browser.close());

test("a run opens from disk, asks for nothing and draws", async () => {
  const page = await browser.open(sampleRun());
  const { share, colours } = await drawn(page, "#view canvas");
  assert.ok(share > 0.05, `only ${share} of the canvas is drawn upon`);
  assert.ok(colours > 20, `only ${colours} colours`);
  assert.equal(await page.locator(".graph .node").count(), 14);
  await quiet(page);
});

test("a study opens from disk, asks for nothing and draws", async () => {
  const page = await browser.open(sampleStudy());
  assert.equal(await page.locator(".study-table tbody tr").count(), 12);
  assert.ok((await drawn(page, ".pane canvas")).share > 0.05);
  await quiet(page);
});
