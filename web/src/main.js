// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { readReport } from "./data/report.js";
import { h } from "./dom.js";
import { bindPrint } from "./print.js";
import { runPage } from "./run/page.js";
import { studyPage } from "./study/page.js";

function start() {
  const page = document.getElementById("page");
  try {
    const report = readReport();
    if (!report) {
      page.replaceChildren(
        h(
          "p",
          { class: "empty" },
          "This is the bare template of a report: `velum report DIR` writes one with data.",
        ),
      );
      return;
    }
    page.replaceChildren(...(report.kind === "study" ? studyPage(report) : runPage(report)));
    bindPrint();
  } catch (error) {
    page.replaceChildren(
      h(
        "p",
        { class: "banner failed", role: "alert" },
        `This report could not be read: ${error.message}`,
      ),
    );
    throw error;
  }
  document.documentElement.dataset.ready = "yes";
}

start();
