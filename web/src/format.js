// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Numbers as people read them. The data are in SI units; here they get a prefix that suits their size.

const kMinus = "\u2212";
const kNarrow = "\u202f";

/** Up to `digits` significant digits, thousands set apart, a real minus sign. */
export function number(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "\u2013";
  if (!Number.isFinite(value)) return value > 0 ? "\u221e" : `${kMinus}\u221e`;
  if (value === 0) return "0";
  const size = Math.abs(value);
  let text;
  if (size >= 1e9 || size < 1e-4) {
    const [mantissa, exponent] = value.toExponential(Math.max(0, digits - 1)).split("e");
    text = `${Number(mantissa)}\u00b710${superscript(Number(exponent))}`;
  } else if (Number.isInteger(value)) {
    text = grouped(String(value));
  } else {
    const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
    text = grouped(
      value
        .toFixed(Math.min(decimals, 12))
        .replace(/(\.\d*?)0+$/, "$1")
        .replace(/\.$/, ""),
    );
  }
  return text.replace("-", kMinus);
}

const superscript = (n) =>
  String(n).replace(/[-\d]/g, (c) =>
    c === "-" ? "\u207b" : "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[c],
  );

function grouped(text) {
  const [whole, fraction] = text.split(".");
  const digits = whole.replace("-", "");
  const wide = digits.length > 4 ? whole.replace(/\B(?=(\d{3})+(?!\d))/g, kNarrow) : whole;
  return fraction ? `${wide}.${fraction}` : wide;
}

export const integer = (value) => grouped(String(Math.round(value)));

/** The unit as printed: "m^2" becomes m², "deg" the degree sign. */
export const unitText = (unit) =>
  (unit ?? "").replace("^2", "\u00b2").replace("^3", "\u00b3").replace(/^deg$/, "\u00b0");

/** How to show values of this size in this unit: displayed = factor * value, in `unit`. */
export function scaleFor(unit, size) {
  const big = Math.abs(size);
  if (unit === "m") {
    if (big > 0 && big < 0.5) return { factor: 1e3, unit: "mm" };
    return { factor: 1, unit: "m" };
  }
  if (unit === "m^2")
    return big > 0 && big < 1e-2
      ? { factor: 1e6, unit: "mm\u00b2" }
      : { factor: 1, unit: "m\u00b2" };
  if (unit === "rad") return { factor: 180 / Math.PI, unit: "\u00b0" };
  if (unit === "s") {
    if (big > 0 && big < 0.1) return { factor: 1e3, unit: "ms" };
    return big >= 600 ? { factor: 1 / 60, unit: "min" } : { factor: 1, unit: "s" };
  }
  if (unit === "B" || unit === "bytes" || unit === "byte") {
    if (big >= 1e9) return { factor: 1e-9, unit: "GB" };
    return big >= 1e6 ? { factor: 1e-6, unit: "MB" } : { factor: 1e-3, unit: "kB" };
  }
  return { factor: 1, unit: unitText(unit) };
}

/** A value with its unit, in the prefix that suits it. */
export function quantity(value, unit, digits = 4) {
  if (value === null || value === undefined) return "\u2013";
  const scale = scaleFor(unit, value);
  return withUnit(number(value * scale.factor, digits), scale.unit);
}

export const withUnit = (text, unit) =>
  unit ? (unit === "\u00b0" ? `${text}\u00b0` : `${text}\u00a0${unit}`) : text;

export const seconds = (value) => quantity(value, "s", 3);
export const bytes = (value) => quantity(value, "bytes", 3);

/** A name with its unit for the head of a column or an axis. */
export const heading = (name, unit) => (unit ? `${name} [${unit}]` : name);

/** "2026-03-01T12:00:00Z" as 2026-03-01 12:00:00 UTC. */
export const moment = (iso) => (iso ?? "").replace("T", " ").replace("Z", " UTC");

/** A parameter's value as the record has it. */
export function parameter(value, unit) {
  if (value === null || value === undefined) return "not set";
  if (Array.isArray(value))
    return value.length === 0 ? "none" : value.map((one) => parameter(one, unit)).join(", ");
  if (typeof value === "object")
    return Object.entries(value)
      .map(([key, one]) => `${key}: ${parameter(one, unit)}`)
      .join(", ");
  if (typeof value === "number") return quantity(value, unit, 6);
  return String(value);
}
