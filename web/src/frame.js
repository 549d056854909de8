// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// What both pages share: head, sections with their list, the part on stages.
import { h } from "./dom.js";

/** Head, list of sections and sections; `sections` are [id, title, content], without content left out. */
export function frame({ kicker, title, facts, banner, sections, version }) {
  document.title = `${title} \u2013 Velum`;
  const shown = sections.filter(([, , content]) => content);
  return [
    h(
      "header",
      { class: "top" },
      h("p", { class: "kicker" }, kicker),
      h("h1", {}, title),
      h(
        "dl",
        { class: "facts" },
        facts
          .filter(Boolean)
          .map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))),
      ),
    ),
    h(
      "nav",
      { class: "contents", "aria-label": "sections" },
      h(
        "ul",
        {},
        shown.map(([id, text]) => h("li", {}, h("a", { href: `#${id}` }, text))),
      ),
    ),
    ...(banner ? [banner] : []),
    ...shown.map(([id, text, content]) =>
      h(
        "section",
        { id, "aria-labelledby": `${id}-title` },
        h("h2", { id: `${id}-title` }, text),
        content,
      ),
    ),
    h("footer", {}, `Velum ${version}. This page is one file and asks nothing of a network.`),
  ];
}

/** References and licences of the stages used. */
export function stagesSection(stages) {
  const ids = Object.keys(stages).sort();
  if (ids.length === 0) return null;
  return h(
    "div",
    { class: "scroll" },
    h(
      "table",
      { class: "stages" },
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          ["stage", "what it does", "same again?", "licence", "references"].map((text) =>
            h("th", { scope: "col" }, text),
          ),
        ),
      ),
      h(
        "tbody",
        {},
        ids.map((id) =>
          h(
            "tr",
            {},
            h(
              "th",
              { scope: "row" },
              h("code", {}, id),
              stages[id].version && h("small", {}, ` version ${stages[id].version}`),
            ),
            h("td", {}, stages[id].summary),
            h(
              "td",
              {},
              {
                bitwise: "same bytes",
                seeded: "same bytes for a seed",
                tolerance: "within tolerance",
                none: "no",
              }[stages[id].determinism] ?? stages[id].determinism,
            ),
            h("td", {}, stages[id].licence),
            h(
              "td",
              {},
              (stages[id].references ?? []).length
                ? h(
                    "ul",
                    { class: "plain" },
                    stages[id].references.map((text) => h("li", {}, text)),
                  )
                : "\u2013",
            ),
          ),
        ),
      ),
    ),
  );
}
