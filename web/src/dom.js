// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

const kSvg = "http://www.w3.org/2000/svg";

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name === "style" && typeof value === "object") Object.assign(element.style, value);
    else if (name === "value") element.value = value;
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(
    ...children.flat(3).filter((child) => child !== null && child !== undefined && child !== false),
  );
  return element;
}

/** An HTML element: attributes, listeners as `onclick`, children as text or elements; null is left out. */
export const h = (tag, attributes, ...children) =>
  fill(document.createElement(tag), attributes, children);

/** The same for SVG. */
export const s = (tag, attributes, ...children) =>
  fill(document.createElementNS(kSvg, tag), attributes, children);

let ids = 0;
/** A new id, to tie a label or a description to its element. */
export const newId = (stem) => `${stem}-${++ids}`;

/** A select with its label. `options` are [value, text] or [value, text, group]. */
export function choice(label, options, value, onChange, attributes = {}) {
  const groups = new Map();
  const select = h("select", {
    "aria-label": label,
    ...attributes,
    onchange: (event) => onChange(event.target.value),
  });
  for (const [key, text, group] of options) {
    const option = h("option", { value: key, selected: key === value }, text);
    if (!group) select.append(option);
    else {
      if (!groups.has(group)) {
        groups.set(group, h("optgroup", { label: group }));
        select.append(groups.get(group));
      }
      groups.get(group).append(option);
    }
  }
  return h("label", { class: "field" }, h("span", {}, label), select);
}

/** A check box with its label. */
export function tick(label, checked, onChange, attributes = {}) {
  const box = h("input", {
    type: "checkbox",
    checked,
    ...attributes,
    onchange: (event) => onChange(event.target.checked),
  });
  return h("label", { class: "tick" }, box, h("span", {}, label));
}

export const button = (text, onclick, attributes = {}) =>
  h("button", { type: "button", ...attributes, onclick }, text);

/** Copies text; where the browser refuses, selects it in a text field. Says which. */
export async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const area = h("textarea", { class: "offscreen", "aria-hidden": "true" }, text);
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done;
  }
}

/** A button that copies what `text()` gives and says so for a moment. */
export function copyButton(label, text, attributes = {}) {
  const self = button(
    label,
    async () => {
      const done = await copyText(text());
      self.textContent = done ? "Copied" : "Could not copy";
      setTimeout(() => {
        self.textContent = label;
      }, 1500);
    },
    attributes,
  );
  return self;
}

/** Offers text as a file. */
export function download(name, content, type) {
  const url = URL.createObjectURL(new Blob([content], { type }));
  h("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}
