// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

/** On paper everything that is folded is open. */
export function bindPrint() {
  let opened = [];
  window.addEventListener("beforeprint", () => {
    opened = [...document.querySelectorAll("details:not([open]):not(.screen-only)")];
    for (const one of opened) one.open = true;
  });
  window.addEventListener("afterprint", () => {
    for (const one of opened) one.open = false;
  });
}
