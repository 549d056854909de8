// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// What the parts of a study's page ask of its JSON.
import { categoryCss } from "../colour.js";
import { heading, scaleFor } from "../format.js";

const kCost = /(^|\.)(seconds|cpu_seconds|peak_bytes)$/;

export class Study {
  constructor(report) {
    Object.assign(this, report.study);
    this.axes ??= [];
    this.variants ??= [];
    // Very large studies come without the single runs.
    this.hasRuns = this.variants.some((variant) => variant.runs?.length);
    for (const variant of this.variants) variant.runs ??= [];
    this.names = Object.keys(this.measures ?? {});
    // An axis that has one value only tells no variants apart.
    this.telling = this.axes.filter((axis) => axis.values.length > 1);
    this.colours = new Map(
      (this.telling[0]?.values ?? []).map((value, i) => [value, categoryCss(i)]),
    );
    this.scales = new Map(
      this.names.map((name) => [name, scaleFor(this.unitOf(name), this.#size(name))]),
    );
  }

  /** peak_bytes has its unit in its name. */
  unitOf(name) {
    return this.measures[name].unit || (/peak_bytes$/.test(name) ? "bytes" : "");
  }

  #size(name) {
    return Math.max(
      0,
      ...this.variants.map((variant) => Math.abs(variant.summary?.[name]?.mean ?? 0)),
    );
  }

  /** Name and unit as shown. */
  titled(name) {
    return heading(name, this.scales.get(name).unit);
  }

  better(name) {
    return this.measures[name].better;
  }

  /** In the unit as shown. */
  shown(name, value) {
    return value * this.scales.get(name).factor;
  }

  values(variant, name) {
    return variant.runs
      .filter((run) => run.status === "ok" && typeof run.measures?.[name] === "number")
      .map((run) => run.measures[name]);
  }

  /** What tells a variant apart, short. */
  label(variant, axes = this.telling) {
    return axes.map((axis) => variant.axes[axis.name]).join(" \u00b7 ") || variant.id;
  }

  colour(variant) {
    return this.colours.get(variant.axes[this.telling[0]?.name]) ?? categoryCss(0);
  }

  /** A first choice for a scatter: an accuracy across, a cost up. */
  firstPair() {
    const accuracy = this.names.find((name) => !kCost.test(name)) ?? this.names[0];
    const cost =
      this.names.find((name) => kCost.test(name) && name !== accuracy) ??
      this.names.find((name) => name !== accuracy);
    return [cost ?? accuracy, accuracy];
  }

  hasRepeats() {
    return this.variants.some((variant) =>
      Object.values(variant.summary ?? {}).some((summary) => summary.count > 1),
    );
  }
}

/** "80 mm" as 80 in "mm"; null unless all values of an axis are numbers in one unit. */
export function numericAxis(axis) {
  const parsed = axis.values.map((text) => /^\s*([-+]?[\d.]+(?:e[-+]?\d+)?)\s*(\D*)$/i.exec(text));
  if (parsed.some((match) => !match) || new Set(parsed.map((match) => match[2])).size > 1)
    return null;
  return {
    unit: parsed[0][2].trim(),
    at: new Map(axis.values.map((text, i) => [text, Number(parsed[i][1])])),
  };
}
