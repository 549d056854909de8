// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { copyButton, download, button, h } from "../dom.js";

/** How to do it again, and the graph as it ran. */
export function againSection(run) {
  const command = "velum rerun run.json";
  const { resolved } = run.graph;
  return [
    h(
      "p",
      {},
      "In the folder of this report; it says whether the results are the same, or what differs:",
    ),
    h(
      "div",
      { class: "command" },
      h("pre", {}, h("code", {}, command)),
      copyButton("Copy", () => command),
    ),
    h(
      "p",
      { class: "hint" },
      `Graph ${run.graph.path}, hash ${run.graph.hash}, seed ${run.seed}, Velum ${run.velum}, ${run.machine?.instruction_set ?? ""}.`,
    ),
    resolved &&
      h(
        "details",
        {},
        h("summary", {}, "The graph as it ran, included files merged and settings applied"),
        h(
          "div",
          { class: "buttons" },
          copyButton("Copy", () => resolved),
          button("Download", () => download("graph.toml", resolved, "application/toml")),
        ),
        h("pre", { class: "toml" }, resolved),
      ),
  ];
}
