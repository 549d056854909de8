// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
//
// node test/run.mjs PAGE COMMAND: the tests of the page; exit 77 where they cannot be run here.
import { spawnSync } from "node:child_process";
import { existsSync, readdirSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const [page, command = ""] = process.argv.slice(2);
const chromium = process.env.CHROMIUM ?? "/usr/bin/chromium";

for (const [path, what] of [
  [chromium, "Chromium (Debian: chromium)"],
  [join(here, "..", "node_modules", "playwright-core"), "playwright-core (npm ci in web/)"],
  [page, "the built page"],
])
  if (!existsSync(path)) {
    console.log(`skipped: ${what} is not there`);
    process.exit(77);
  }

const tests = readdirSync(here)
  .filter((name) => name.endsWith(".test.mjs"))
  .map((name) => join(here, name));
const { status } = spawnSync(process.execPath, ["--test", ...tests], {
  stdio: "inherit",
  env: { ...process.env, CHROMIUM: chromium, VELUM_PAGE: resolve(page), VELUM_COMMAND: command },
});
process.exit(status ?? 1);
