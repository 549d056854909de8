// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Tables and transforms that the run made, as they are.
import { h } from "../dom.js";
import { heading, number, unitText } from "../format.js";

const kMostRows = 200;

export function tablesSection(report) {
  const tables = report.values.filter((value) => value.rows?.rows.length);
  const transforms = report.values.filter((value) => value.matrix);
  if (tables.length + transforms.length === 0) return null;
  return [...transforms.map(transform), ...tables.map(table)];
}

function table(value) {
  const { columns, rows } = value.rows;
  return h(
    "details",
    {},
    h(
      "summary",
      {},
      h("b", {}, value.id),
      h("small", {}, ` ${rows.length} ${rows.length === 1 ? "row" : "rows"}`),
    ),
    h(
      "div",
      { class: "scroll" },
      h(
        "table",
        {},
        h(
          "thead",
          {},
          h(
            "tr",
            {},
            columns.map(({ name, unit }) =>
              h("th", { scope: "col" }, heading(name, unitText(unit))),
            ),
          ),
        ),
        h(
          "tbody",
          {},
          rows.slice(0, kMostRows).map((row) =>
            h(
              "tr",
              {},
              row.map((cell) =>
                typeof cell === "number"
                  ? h("td", { class: "n" }, number(cell, 6))
                  : h("td", {}, cell ?? "\u2013"),
              ),
            ),
          ),
        ),
      ),
    ),
    rows.length > kMostRows &&
      h("p", { class: "hint" }, `and ${rows.length - kMostRows} more rows`),
  );
}

function transform(value) {
  const rows = [0, 4, 8, 12].map((at) => value.matrix.flat().slice(at, at + 4));
  return h(
    "details",
    {},
    h("summary", {}, h("b", {}, value.id), h("small", {}, " transform, row by row, metres")),
    h(
      "div",
      { class: "scroll" },
      h(
        "table",
        { class: "matrix" },
        h(
          "tbody",
          {},
          rows.map((row) =>
            h(
              "tr",
              {},
              row.map((x) => h("td", { class: "n" }, x.toFixed(9))),
            ),
          ),
        ),
      ),
    ),
  );
}
