// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A headless Chromium that notes what a page must not do.
import assert from "node:assert/strict";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

const kFlags = [
  "--no-sandbox",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--enable-unsafe-swiftshader",
];
const kSlow = 60000; // a loaded machine draws in software

export class Browser {
  static async start() {
    const self = new Browser();
    self.browser = await chromium.launch({
      executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
      args: kFlags,
    });
    self.folder = await mkdtemp(join(tmpdir(), "velum-web-"));
    self.template = await readFile(
      process.env.VELUM_PAGE ?? join(import.meta.dirname ?? ".", "..", "dist", "report.html"),
      "utf8",
    );
    return self;
  }

  /** Opens a report from disk. `page.faults` collects console errors, exceptions and requests. */
  async open({ packer, json }, options = {}) {
    const file = join(this.folder, `${json.kind}-${Math.random().toString(36).slice(2)}.html`);
    await writeFile(file, packer.page(this.template, json));
    return this.openFile(file, options);
  }

  /** `options.init` runs in the page before its own script. */
  async openFile(file, { init, ...options } = {}) {
    const context = await this.browser.newContext({
      viewport: { width: 1280, height: 900 },
      ...options,
    });
    const page = await context.newPage();
    if (init) await page.addInitScript(init);
    page.setDefaultTimeout(kSlow);
    page.faults = [];
    page.on(
      "console",
      (message) => message.type() === "error" && page.faults.push(`console: ${message.text()}`),
    );
    page.on("pageerror", (error) => page.faults.push(`exception: ${error.message}`));
    page.on("request", (request) => {
      if (!/^(data|blob):/.test(request.url()) && request.url() !== `file://${file}`)
        page.faults.push(`request: ${request.url()}`);
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
  await page.context().close();
}

/** What can be worked and has no accessible name. */
export const nameless = (page) =>
  page.evaluate(() =>
    [
      ...document.querySelectorAll(
        "button, select, input, textarea, a[href], canvas, [role=img], [role=link], svg[role]",
      ),
    ]
      .filter(
        (element) =>
          !(
            element.getAttribute("aria-label") ||
            element.labels?.length ||
            element.textContent.trim() ||
            element.closest("[aria-hidden=true]") ||
            element.closest(".plot > *")
          ),
      )
      .map((element) => element.outerHTML.slice(0, 120)),
  );

/** Share of the canvas that is drawn upon, how many different colours there are, and their mean. */
export const drawn = (page, selector) =>
  page.evaluate(async (selector) => {
    const canvas = document.querySelector(selector);
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    const copy = document.createElement("canvas");
    copy.width = canvas.width;
    copy.height = canvas.height;
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    let inked = 0;
    const mean = [0, 0, 0];
    const colours = new Set();
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] < 200) continue;
      ++inked;
      for (const channel of [0, 1, 2]) mean[channel] += data[i + channel];
      colours.add((data[i] >> 4) * 256 + (data[i + 1] >> 4) * 16 + (data[i + 2] >> 4));
    }
    return {
      share: inked / (copy.width * copy.height),
      colours: colours.size,
      mean: mean.map((sum) => Math.round(sum / Math.max(1, inked))),
    };
  }, selector);
