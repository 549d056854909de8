// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
//
// node build.mjs OUT: bundles the page into one HTML file that asks for nothing else.
import { build } from "esbuild";
import { mkdir, readFile, rename, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, "dist", "report.html");

async function bundle(entry) {
  const result = await build({
    entryPoints: [join(here, "src", entry)],
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: ["chrome105", "firefox110", "safari16"],
    legalComments: "inline",
    charset: "ascii",
    logLevel: "warning",
  });
  return result.outputFiles[0].text;
}

/** What would end or confuse an HTML script element; inside strings and regular expressions only. */
const scriptSafe = (text) =>
  text.replaceAll("<!--", "\\x3C!--").replaceAll(/<(\/?script)/gi, "\\x3C$1");

/** The licences that must stand in every copy. */
async function notices() {
  const texts = await Promise.all(
    ["three", "plotly.js-cartesian-dist-min"].map(
      async (name) =>
        `${name}\n\n${(await readFile(join(here, "node_modules", name, "LICENSE"), "utf8")).trim()}`,
    ),
  );
  return `/*!\nThis page contains:\n\n${texts.join("\n\n")}\n*/\n`;
}

const [page, script, style, licences] = await Promise.all([
  readFile(join(here, "src", "page.html"), "utf8"),
  bundle("main.js"),
  bundle("style.css"),
  notices(),
]);
const html = page
  .replace("/* velum:style */", () => style.replaceAll("</style", "<\\/style"))
  .replace("/* velum:script */", () => licences + scriptSafe(script));
if (html.split("\n").filter((line) => line === "<!-- velum:data -->").length !== 1)
  throw new Error("the page must have exactly one line <!-- velum:data -->");

await mkdir(dirname(out), { recursive: true });
await writeFile(`${out}.part`, html);
await rename(`${out}.part`, out);
