// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// All variants, or all cells, to sort and to filter. Large studies are shown page by page.
import { button, choice, h } from "../dom.js";
import { integer, number } from "../format.js";

const kPage = 100;

export function tableSection(study, downloadCsv) {
  const state = { by: "variants", text: "", status: "", page: 0, sort: null, down: false };
  const holder = h("div", {
    class: "scroll",
    tabindex: "0",
    role: "region",
    "aria-label": "table of variants",
  });
  const count = h("small", { role: "status" });
  const pager = h("span", { class: "buttons" });
  const draw = () => drawTable(study, state, holder, count, pager, draw);
  const set = (key) => (value) => {
    state[key] = value;
    state.page = 0;
    if (key === "by") state.sort = null;
    draw();
  };
  const search = h("input", {
    type: "search",
    placeholder: "filter: words, all must occur",
    "aria-label": "filter the table",
    oninput: () => set("text")(search.value),
  });
  const states = [
    ...new Set(
      study.variants.flatMap((variant) => [
        variant.status,
        ...variant.runs.map((run) => run.status),
      ]),
    ),
  ];
  draw();
  return [
    h(
      "div",
      { class: "filters" },
      study.hasRuns &&
        choice(
          "rows",
          [
            ["variants", "a variant each"],
            ["cells", "a cell each"],
          ],
          "variants",
          set("by"),
        ),
      search,
      states.length > 1 &&
        choice(
          "status",
          [["", "any"], ["failed", "not ok"], ...states.map((one) => [one, one])],
          "",
          set("status"),
        ),
      downloadCsv && button("Download CSV", downloadCsv),
      count,
      pager,
    ),
    holder,
    h(
      "p",
      { class: "hint" },
      "Mean \u00b1 standard deviation over the repeats that are ok. Green: best of those compared. * differs from the reference variant by more than chance (p < 5 %, exact signed-rank test, Holm-corrected).",
    ),
  ];
}

function columnsOf(study, by) {
  const axes = study.axes.map((axis) => ({
    id: `axis ${axis.name}`,
    name: axis.name || "axis",
    key: ({ variant }) => orderOf(axis, variant.axes[axis.name]),
    cell: ({ variant }) => h("td", {}, variant.axes[axis.name]),
  }));
  const groups = new Set(study.variants.map((variant) => variant.data)).size > 1;
  const measures = study.names.map((name) => ({
    id: name,
    name: study.titled(name),
    numeric: true,
    key:
      by === "cells"
        ? ({ run }) => run.measures?.[name]
        : ({ variant }) => variant.summary?.[name]?.mean,
    cell:
      by === "cells"
        ? ({ run }) =>
            h(
              "td",
              { class: "n" },
              typeof run.measures?.[name] === "number"
                ? number(study.shown(name, run.measures[name]))
                : "\u2013",
            )
        : ({ variant }) => meanCell(study, variant, name),
  }));
  const status = {
    id: "status",
    name: "status",
    key: (row) => statusOf(row),
    cell: (row) =>
      h(
        "td",
        {},
        h("span", { class: `status ${statusOf(row)}` }, statusOf(row).replaceAll("_", " ")),
      ),
  };
  const message = {
    id: "message",
    name: "message",
    key: (row) => messageOf(row),
    cell: (row) => h("td", { class: "message" }, messageOf(row)),
  };
  const anyMessage = study.variants.some(
    (variant) => variant.message || variant.runs.some((run) => run.message),
  );
  return [
    {
      id: "variant",
      name: "variant",
      key: ({ index }) => index,
      cell: ({ variant }) => h("th", { scope: "row" }, variant.id),
    },
    by === "cells" && {
      id: "repeat",
      name: "repeat",
      numeric: true,
      key: ({ run }) => run.repeat,
      cell: ({ run }) => h("td", { class: "n" }, run.repeat),
    },
    ...axes,
    groups && {
      id: "data",
      name: "data",
      key: ({ variant }) => variant.data,
      cell: ({ variant }) => h("td", {}, variant.data + 1),
    },
    status,
    by === "variants" && {
      id: "success",
      name: "ok",
      numeric: true,
      key: ({ variant }) => variant.success,
      cell: ({ variant }) => h("td", { class: "n" }, `${number(100 * variant.success, 3)}\u00a0%`),
    },
    ...measures,
    anyMessage && message,
  ].filter(Boolean);
}

const orderOf = (axis, value) => axis.values.indexOf(value);
const statusOf = ({ variant, run }) => (run ?? variant).status;
const messageOf = ({ variant, run }) => (run ? run.message : variant.message) ?? "";

function meanCell(study, variant, name) {
  const summary = variant.summary?.[name];
  if (!summary || !summary.count) return h("td", { class: "n" }, "\u2013");
  const star = summary.difference?.p !== null && summary.difference?.p < 0.05;
  const told = [
    summary.rank ? `rank ${summary.rank}` : "",
    summary.difference
      ? `${number(study.shown(name, summary.difference.mean))} from ${summary.difference.reference}${summary.difference.p === null ? "" : `, p = ${number(summary.difference.p, 2)}`}`
      : "",
    `95 % of the mean: ${summary.ci95.map((x) => number(study.shown(name, x))).join(" to ")}`,
  ]
    .filter(Boolean)
    .join("; ");
  return h(
    "td",
    { class: `n ${summary.rank === 1 ? "best" : ""}`, title: told },
    number(study.shown(name, summary.mean)),
    summary.count > 1 &&
      h("span", { class: "spread" }, ` \u00b1\u00a0${number(study.shown(name, summary.sd), 2)}`),
    star && " *",
  );
}

function rowsOf(study, state) {
  const words = state.text.toLowerCase().split(/\s+/).filter(Boolean);
  const rows = study.variants.flatMap((variant, index) =>
    state.by === "cells"
      ? variant.runs.map((run) => ({ variant, run, index }))
      : [{ variant, index }],
  );
  return rows.filter((row) => {
    const status = statusOf(row);
    if (
      state.status === "failed"
        ? status === "ok"
        : state.status &&
          status !== state.status &&
          !(state.by === "variants" && row.variant.runs.some((run) => run.status === state.status))
    )
      return false;
    if (words.length === 0) return true;
    const text = [row.variant.id, ...Object.values(row.variant.axes), status, messageOf(row)]
      .join(" ")
      .toLowerCase();
    return words.every((word) => text.includes(word));
  });
}

function sorted(rows, column, down) {
  if (!column) return rows;
  const order = (a, b) => {
    const x = column.key(a),
      y = column.key(b);
    const emptyX = x === undefined || x === null || x === "",
      emptyY = y === undefined || y === null || y === "";
    if (emptyX || emptyY) return emptyX - emptyY; // what is missing comes last, up or down
    const sign =
      typeof x === "number" && typeof y === "number" ? x - y : String(x).localeCompare(String(y));
    return down ? -sign : sign;
  };
  return [...rows].sort(order);
}

function drawTable(study, state, holder, count, pager, draw) {
  const columns = columnsOf(study, state.by);
  const found = sorted(
    rowsOf(study, state),
    columns.find((column) => column.id === state.sort),
    state.down,
  );
  const pages = Math.max(1, Math.ceil(found.length / kPage));
  const shown = found.slice(state.page * kPage, (state.page + 1) * kPage);
  const sortBy = (id) => () => {
    state.down = state.sort === id ? !state.down : false;
    state.sort = id;
    state.page = 0;
    draw();
    holder.querySelector(`th[data-column="${CSS.escape(id)}"] button`)?.focus();
  };
  const heads = columns.map((column) =>
    h(
      "th",
      {
        scope: "col",
        class: column.numeric ? "n" : null,
        "data-column": column.id,
        "aria-sort": state.sort === column.id ? (state.down ? "descending" : "ascending") : "none",
      },
      button(column.name, sortBy(column.id)),
    ),
  );
  holder.replaceChildren(
    h(
      "table",
      { class: "study-table" },
      h("thead", {}, h("tr", {}, heads)),
      h(
        "tbody",
        {},
        shown.map((row) =>
          h(
            "tr",
            { class: statusOf(row) === "ok" ? null : "bad" },
            columns.map((column) => column.cell(row)),
          ),
        ),
      ),
    ),
  );
  count.textContent = `${integer(found.length)} ${state.by}`;
  const turn = (by, text) =>
    button(
      text,
      () => {
        state.page += by;
        draw();
      },
      { disabled: state.page + by < 0 || state.page + by >= pages },
    );
  pager.replaceChildren(
    ...(pages > 1
      ? [
          turn(-1, "\u2039"),
          h("small", {}, `page ${state.page + 1} of ${pages}`),
          turn(1, "\u203a"),
        ]
      : []),
  );
}
