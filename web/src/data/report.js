// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// The data that the command has put into the page: one JSON and one block of binary data.
import { bytesOf } from "./base64.js";
import { Value } from "./value.js";

/** Reads both script elements; null where the page has no data (the bare template). */
export function readReport(root = document) {
  const json = root.getElementById("velum-report");
  if (!json) return null;
  const report = JSON.parse(json.textContent);
  if (report.format !== 1)
    throw new Error(`this page reads reports of format 1, not ${report.format}`);
  const block = bytesOf(root.getElementById("velum-data")?.textContent ?? "");
  report.values = (report.values ?? []).map((value) => new Value(value, block));
  report.histograms ??= [];
  report.stages ??= {};
  return report;
}

/** Values that have a shape to show. */
export const shapes = (report) => report.values.filter((value) => value.hasShape());
