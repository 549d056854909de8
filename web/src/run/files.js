// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { h } from "../dom.js";
import { bytes } from "../format.js";

/** Files that the run read and wrote, with their hashes. */
export function filesSection(run) {
  const parts = [
    ["Written", run.files ?? []],
    ["Read", run.inputs ?? []],
  ].filter(([, list]) => list.length);
  if (parts.length === 0) return null;
  return h(
    "div",
    { class: "scroll" },
    h(
      "table",
      {},
      parts.map(([title, list]) =>
        h(
          "tbody",
          {},
          h("tr", {}, h("th", { colspan: 4, class: "note" }, title)),
          list.map((file) =>
            h(
              "tr",
              {},
              h("th", { scope: "row" }, file.path),
              h("td", {}, file.node ?? ""),
              h("td", { class: "n" }, bytes(file.bytes)),
              h("td", { class: "hash" }, file.hash),
            ),
          ),
        ),
      ),
    ),
  );
}
