// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { h } from "../dom.js";

/** The error of a run and the warnings of its nodes; null where there are none. */
export function banner(run) {
  const warnings = run.nodes.flatMap((node) =>
    (node.warnings ?? []).map((text) => ({ node: node.name, text })),
  );
  if (!run.error && warnings.length === 0) return null;
  return h(
    "div",
    { class: "banners" },
    run.error &&
      h(
        "div",
        { class: "banner failed", role: "alert" },
        h(
          "p",
          {},
          h("b", {}, run.error.code),
          ` in ${run.error.node ?? "the run"}${run.error.stage ? ` (${run.error.stage})` : ""}: ${run.error.message}`,
        ),
        run.error.where && h("p", {}, run.error.where),
        run.error.hint && h("p", {}, h("i", {}, run.error.hint)),
      ),
    warnings.length > 0 &&
      h(
        "div",
        { class: "banner warning" },
        h(
          "p",
          {},
          h("b", {}, warnings.length === 1 ? "One warning" : `${warnings.length} warnings`),
        ),
        h(
          "ul",
          {},
          warnings.map(({ node, text }) =>
            h("li", {}, h("a", { href: `#node-${node}` }, node), `: ${text}`),
          ),
        ),
      ),
  );
}
