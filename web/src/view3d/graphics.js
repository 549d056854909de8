// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { h } from "../dom.js";

/** What `make()` gives; where the browser has no WebGL 2, a sentence instead, and the rest of the page. */
export function withGraphics(make) {
  if (!document.createElement("canvas").getContext("webgl2"))
    return h(
      "p",
      { class: "banner warning" },
      "The 3-D views need WebGL 2, which this browser does not give. Everything else is here.",
    );
  return make();
}
