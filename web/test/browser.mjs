// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A headless Chromium that notes what a page must not do.
import assert from "node:assert/strict";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

const kFlags = ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--enable-unsafe-swiftshader"];
const kSlow = 60000;  // a loaded machine draws in software

export class Browser {
  static async start() {
    const self = new Browser();
    self.browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: kFlags });
    self.folder = await mkdtemp(join(tmpdir(), "velum-web-"));
    self.template = await readFile(process.env.VELUM_PAGE ?? join(import.meta.dirname ?? ".", "..", "dist", "report.html"), "utf8");
    return self;
  }

  /** Opens a report from disk. `page.faults` collects console errors, exceptions and requests. */
  async open({ packer, json }, options = {}) {
    const file = join(this.folder, `${json.kind}-${Math.random().toString(36).slice(2)}.html`);
    await writeFile(file, packer.page(this.template, json));
    return this.openFile(file, options);
  }

  async openFile(file, options = {}) {
    const page = await this.browser.newPage({ viewport: { width: 1280, height: 900 }, ...options });
    page.setDefaultTimeout(kSlow);
    page.faults = [];
    page.on("console", (message) => message.type() === "error" && page.faults.push(`console: ${message.text()}`));
    page.on("pageerror", (error) => page.faults.push(`exception: ${error.message}`));
    page.on("request", (request) => {
      if (!/^(data|blob):/.test(request.url()) && request.url() !== `file://${file}`) page.faults.push(`request: ${request.url()}`);
    });
    await page.goto(`file://${file}`);
    await page.waitForSelector("html[data-ready=yes]");
    return page;
  }

  async close() {
    await this.browser.close();
    await rm(this.folder, { recursive: true, force: true });
  }
}

/** Closes a page that did nothing it must not. */
export async function quiet(page) {
  assert.deepEqual(page.faults, []);
  await page.close();
}

/** Share of the canvas that is drawn upon, and how many different colours there are. */
export const drawn = (page, selector) => page.evaluate(async (selector) => {
  const canvas = document.querySelector(selector);
  await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  const copy = document.createElement("canvas");
  copy.width = canvas.width;
  copy.height = canvas.height;
  const context = copy.getContext("2d");
  context.drawImage(canvas, 0, 0);
  const { data } = context.getImageData(0, 0, copy.width, copy.height);
  let inked = 0;
  const colours = new Set();
  for (let i = 0; i < data.length; i += 4) {
    if (data[i + 3] < 200) continue;
    ++inked;
    colours.add((data[i] >> 4) * 256 + (data[i + 1] >> 4) * 16 + (data[i + 2] >> 4));
  }
  return { share: inked / (copy.width * copy.height), colours: colours.size };
}, selector);
