// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Browser, drawn, nameless, quiet } from "./browser.mjs";
import { sampleRun } from "./sample_run.mjs";
import { sailPoint } from "./shapes.mjs";

let browser;
let page;
before(async () => {
  browser = await Browser.start();
  page = await browser.open(sampleRun());
});
after(() => browser.close());

/** Shows only these values. */
const only = (...ids) =>
  page.evaluate((ids) => {
    for (const entry of window.velum.explorer.entries) entry.show(ids.includes(entry.value.id));
    window.velum.explorer.picks.clear();
    window.velum.view.fit([1, -1.2, 0.7]);
    window.velum.view.drawNow();
  }, ids);

/** Clicks at a pixel of the view, as a person does. */
async function click(x, y) {
  const box = await page.locator("#view canvas").boundingBox();
  await page.mouse.click(box.x + x, box.y + y);
}

const rows = () => page.locator(".picks tbody tr");

test("it opens from disk and draws the graph and the mesh", async () => {
  const { share, colours } = await drawn(page, "#view canvas");
  assert.ok(share > 0.05, `only ${share} of the canvas is drawn upon`);
  assert.ok(colours > 20, `only ${colours} colours`);
  assert.equal(await page.locator(".graph .node").count(), 14);
  for (const id of [
    "graph",
    "view",
    "sails",
    "registration",
    "histograms",
    "nodes",
    "tables",
    "files",
    "stages",
    "again",
  ])
    assert.equal(await page.locator(`section#${id}`).count(), 1, id);
});

test("a click picks the point that is seen there, exactly", async () => {
  await only("scene.cloud");
  await page.locator("#view canvas").scrollIntoViewIfNeeded();
  // For 12 points: what should be picked at their pixel, worked out here from all points.
  const cases = await page.evaluate(() => {
    const { view, explorer } = window.velum;
    const { value, layer } = explorer.entries.find((entry) => entry.value.id === "scene.cloud");
    const eye = view.camera.position;
    const forward = view.controls.target.clone().sub(eye).normalize();
    const all = Array.from({ length: value.shown }, (_, i) => {
      const point = value.point(i);
      return { i, ...view.project(point), depth: view.relative(point).sub(eye).dot(forward) };
    });
    const bestAt = (x, y) => {
      const off = (p) => Math.hypot(p.x - x, p.y - y);
      const under = all.filter((p) => off(p) <= layer.size / 2).sort((a, b) => a.depth - b.depth);
      return (under[0] ?? [...all].sort((a, b) => off(a) - off(b))[0]).i;
    };
    return Array.from({ length: 12 }, (_, k) => {
      const { x, y } = all[(k * 337 + 11) % all.length];
      const [px, py] = [Math.round(x) + (k % 3), Math.round(y)];
      return { x: px, y: py, index: bestAt(px, py), point: value.point(bestAt(px, py)) };
    }).filter(
      ({ x, y }) =>
        x > 5 && y > 5 && x < view.element.clientWidth - 5 && y < view.element.clientHeight - 150,
    );
  });
  assert.ok(cases.length >= 4);
  for (const [i, wanted] of cases.entries()) {
    await click(wanted.x, wanted.y);
    const text = await rows().nth(i).locator("td").allTextContents();
    assert.equal(text[1], `#${wanted.index}`.replace(/^#(\d{2})(\d{3})$/, "#$1\u202f$2"));
    assert.deepEqual(
      text.slice(2, 5),
      wanted.point.map((x) => x.toFixed(4)),
    );
    assert.match(text[6], /label (1|2|3|10)/);
  }
});

test("points are as they were before they were packed, to half a step", async () => {
  const [found, step] = await page.evaluate(() => {
    const { value } = window.velum.explorer.entries.find(
      (entry) => entry.value.id === "truth.mesh",
    );
    return [value.point(90 * 60 + 45), value.step()];
  });
  sailPoint(45 / 89, 60 / 119).forEach((x, axis) =>
    assert.ok(Math.abs(x - found[axis]) <= step[axis] / 2 + 1e-12),
  );
});

test("a click on a mesh picks a vertex of it, and what is behind is hidden", async () => {
  await only("mesh.mesh", "scene.cloud");
  await page.evaluate(() => window.velum.view.fit([0, -1, 0.0001]));
  const at = await page.evaluate(() => {
    const { view, explorer } = window.velum;
    view.drawNow();
    const { value } = explorer.entries.find((entry) => entry.value.id === "mesh.mesh");
    for (const entry of explorer.entries)
      if (entry.value.id === "scene.cloud") {
        entry.layer.colourBy("column:label");
        entry.layer.toggleLabel(10, false);
      }
    return view.project(value.point(60 * 40 + 30));
  });
  await click(Math.round(at.x), Math.round(at.y));
  const text = await rows().first().locator("td").allTextContents();
  assert.equal(text[0], "mesh.mesh");
});

test("points of a hidden label are neither drawn nor picked", async () => {
  await only("parts.clusters");
  const before = (await drawn(page, "#view canvas")).share;
  for (const name of ["floor", "sail", "none"])
    await page.getByLabel(`show cluster ${name}`).uncheck();
  const after = (await drawn(page, "#view canvas")).share;
  assert.ok(after < before, `${after} of the canvas instead of ${before}`);
  const found = await page.evaluate(() => {
    const { view, explorer } = window.velum;
    const { value } = explorer.entries.find((entry) => entry.value.id === "parts.clusters");
    const column = value.columns[0];
    const labels = new Set();
    for (let i = 0; i < value.shown; i += 97) {
      const { x, y } = view.project(value.point(i));
      const pick = view.pickAt(x, y);
      if (pick) labels.add(value.entry(column, pick.index));
    }
    return [...labels];
  });
  assert.deepEqual(found, [1]);
});

test("picks are copied as TOML", async () => {
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await only("scene.cloud", "sail.cloud");
  await page.evaluate(() => {
    const { picks, entries } = window.velum.explorer;
    const value = (id) => entries.find((entry) => entry.value.id === id).value;
    picks.add(value("scene.cloud"), 5);
    picks.add(value("sail.cloud"), 7);
  });
  const point = await page.evaluate(() => window.velum.explorer.picks.list[0].point);
  await page.locator(".copy-remove").click();
  const clean = await page.evaluate(() => navigator.clipboard.readText());
  assert.ok(
    clean.includes(
      `in = "scene.cloud"\npoints = [\n  [${point.map((x) => `"${x.toFixed(5)} m"`).join(", ")}]`,
    ),
    clean,
  );
  await page.locator(".copy-picks").click();
  assert.match(
    await page.evaluate(() => navigator.clipboard.readText()),
    /picks = \[\n {2}\{ source = \["/,
  );
});

test("the view is worked by keyboard", async () => {
  await only("sail.cloud");
  await page.locator("#view canvas").focus();
  const position = () => page.evaluate(() => window.velum.view.camera.position.toArray());
  const away = (a, b) => Math.hypot(...a.map((x, axis) => x - b[axis]));
  let last = await position();
  for (const key of ["ArrowLeft", "ArrowUp", "Shift+ArrowRight", "+", "1", "5", "0"]) {
    await page.keyboard.press(key);
    const now = await position();
    if (key !== "0") assert.ok(away(now, last) > 1e-3, key);
    last = now;
  }
  await page.keyboard.press("4");
  await page.keyboard.press("Enter");
  assert.equal(await rows().count(), 1);
  await page.keyboard.press("Delete");
  assert.equal(await rows().count(), 0);
});

test("a node of the graph opens its card, by keyboard", async () => {
  await page.locator('.graph .node[aria-label^="register"]').focus();
  await page.keyboard.press("Enter");
  const card = page.locator("#node-register");
  assert.ok(await card.evaluate((element) => element.open));
  const text = await card.innerText();
  for (const piece of ["2.66\u00a0mm", "point_to_plane", "100\u00a0mm", "scan_b.cloud"])
    assert.ok(text.includes(piece), piece);
});

test("colours follow their column, range and legend", async () => {
  await only("mesh.mesh");
  const sum = async () => (await drawn(page, "#view canvas")).mean;
  const before = await sum();
  await page.getByLabel("colour of mesh.mesh by").selectOption("column:deviation");
  const legend = await page.locator(".legends .legend").innerText();
  assert.match(legend, /deviation \[mm\]/);
  assert.notDeepEqual(await sum(), before);
  const range = await page.evaluate(
    () => window.velum.explorer.entries.find((entry) => entry.value.id === "mesh.mesh").layer.range,
  );
  assert.ok(Math.abs(range[0] + range[1]) < 1e-9, "a signed column is coloured evenly about zero");
});

test("sections are drawn with the truth beside them", async () => {
  assert.equal(await page.locator(".sail .profiles svg").count(), 3);
  assert.equal(await page.locator(".sail .profiles .other").count(), 3);
  assert.match(await page.locator(".sail .profiles").textContent(), /camber 17\.5\u00a0%/);
});

test("plots are drawn when they come into sight", async () => {
  await page.locator("#histograms .plot").first().scrollIntoViewIfNeeded();
  await page.locator("#histograms .plot .bars path").first().waitFor({ state: "attached" });
});

test("dark mode changes page and plots at once", async () => {
  const look = () =>
    page.evaluate(() => [
      getComputedStyle(document.documentElement).backgroundColor,
      getComputedStyle(document.querySelector(".plot .xtitle, .plot .g-xtitle text")).fill,
    ]);
  await page.emulateMedia({ colorScheme: "light" });
  const light = await look();
  await page.emulateMedia({ colorScheme: "dark" });
  await page.waitForFunction(
    (before) =>
      getComputedStyle(document.querySelector(".plot .xtitle, .plot .g-xtitle text")).fill !==
      before,
    light[1],
  );
  const dark = await look();
  assert.notEqual(light[0], dark[0]);
  await page.emulateMedia({ colorScheme: "light" });
});

test("on paper everything is open and every plot drawn", async () => {
  const pdf = await page.pdf({ format: "A4" });
  assert.ok(pdf.length > 50000);
  await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
  assert.equal(await page.locator("details:not([open])").count(), 0);
  assert.equal(await page.locator(".plot:not(:has(svg))").count(), 0);
  const tooWide = await page.evaluate(
    () =>
      [...document.querySelectorAll(".plot .main-svg")].filter(
        (svg) =>
          svg.getBoundingClientRect().width >
          svg.closest(".plot").getBoundingClientRect().width + 1,
      ).length,
  );
  assert.equal(tooWide, 0);
  await page.evaluate(() => window.dispatchEvent(new Event("afterprint")));
  assert.ok((await page.locator("details:not([open])").count()) > 0);
});

test("everything that can be worked has a name", async () => {
  assert.deepEqual(await nameless(page), []);
});

test("nothing was asked for and nothing complained", () => quiet(page));

test("a failed run says so first, and text is never taken for HTML", async () => {
  const failed = await browser.open(sampleRun({ failed: true }));
  const banner = await failed.locator(".banner.failed").first().innerText();
  assert.match(banner, /E1001 in mesh \(meshing.delaunay_projected\): all points lie on one line/);
  assert.match(
    await failed.locator(".banner.warning").first().innerText(),
    /no part <b>& stay<\/b>/,
  );
  assert.equal(await failed.locator(".graph .node.skipped").count(), 3);
  await quiet(failed);
});

test("without WebGL the rest is there", async () => {
  const plain = await browser.open(sampleRun(), {
    init: () => {
      HTMLCanvasElement.prototype.getContext = () => null;
    },
  });
  assert.match(await plain.locator("#view").innerText(), /need WebGL 2/);
  assert.equal(await plain.locator(".graph .node").count(), 14);
  await quiet(plain);
});
