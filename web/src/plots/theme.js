// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Light and dark, and paper: plots keep their colours inside, so they are told of a change.

const dark = window.matchMedia("(prefers-color-scheme: dark)");
const listeners = new Set();
let printing = false;

export const isDark = () => dark.matches && !printing;

/** Calls `listener` whenever the colours change, or the page is laid out for paper or back. */
export const onTheme = (listener) => listeners.add(listener);

const tell = () => listeners.forEach((listener) => listener());
dark.addEventListener("change", tell);
const setPrinting = (value) => {
  if (printing === value) return;
  printing = value;
  // Laid out as wide as paper is before the plots and views inside are drawn for it.
  document.documentElement.classList.toggle("paper", value);
  tell();
};
window.addEventListener("beforeprint", () => setPrinting(true));
window.addEventListener("afterprint", () => setPrinting(false));
window.matchMedia("print").addEventListener("change", (event) => setPrinting(event.matches));

export const isPrinting = () => printing;

/** Of text and of what measures. */
export const ink = () => (isDark() ? "#d7dee6" : "#25303b");

/** What all plots share. */
export function layoutFor(extra) {
  const line = isDark() ? "#2e3944" : "#dde3e9";
  const axis = {
    gridcolor: line,
    linecolor: isDark() ? "#51606e" : "#9aa7b3",
    zerolinecolor: isDark() ? "#51606e" : "#9aa7b3",
    ticks: "outside",
    ticklen: 4,
    tickcolor: isDark() ? "#51606e" : "#9aa7b3",
    automargin: true,
    title: { standoff: 8 },
    exponentformat: "power",
    minexponent: 5,
  };
  const axes = {};
  for (const key of ["xaxis", "yaxis", "xaxis2", "yaxis2"]) {
    if (key.endsWith("2") && !extra[key]) continue;
    const own = extra[key] ?? {};
    axes[key] = {
      ...axis,
      ...own,
      title: {
        ...axis.title,
        ...(typeof own.title === "string" ? { text: own.title } : own.title),
      },
    };
  }
  return {
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    font: {
      family: "system-ui, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif",
      size: 12,
      color: ink(),
    },
    margin: { l: 56, r: 16, t: 12, b: 44 },
    hoverlabel: { font: { size: 12 } },
    legend: { orientation: "h", y: 1.02, yanchor: "bottom", x: 0 },
    ...extra,
    ...axes,
  };
}
