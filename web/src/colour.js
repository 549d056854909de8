// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Colour maps for numbers, perceptually even, and colours that can be told apart for labels.

// Nine stops of each map; between them they are straight to within 2 % of the originals.
const kStops = {
  viridis: [
    "440154",
    "472d7b",
    "3b528b",
    "2c728e",
    "21918c",
    "28ae80",
    "5ec962",
    "addc30",
    "fde725",
  ],
  cividis: [
    "00204c",
    "05356e",
    "404d6b",
    "60636e",
    "7c7b77",
    "9b9377",
    "bcae6e",
    "dfca5d",
    "ffe945",
  ],
  "blue to red": [
    "2166ac",
    "4393c3",
    "92c5de",
    "d1e5f0",
    "f2efee",
    "fddbc7",
    "f4a582",
    "d6604d",
    "b2182b",
  ],
  grey: ["202020", "3a3a3a", "555555", "707070", "8b8b8b", "a6a6a6", "c1c1c1", "dcdcdc", "f4f4f4"],
};

export const mapNames = Object.keys(kStops);

const rgbOf = (hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16));

/** The colour at 0 <= t <= 1 as [r, g, b] of 255. */
export function mapped(name, t) {
  const stops = kStops[name] ?? kStops.viridis;
  const x = Math.min(Math.max(t, 0), 1) * (stops.length - 1);
  const i = Math.min(Math.floor(x), stops.length - 2);
  const a = rgbOf(stops[i]);
  const b = rgbOf(stops[i + 1]);
  return a.map((from, channel) => Math.round(from + (b[channel] - from) * (x - i)));
}

/** A CSS gradient of the map, from left to right. */
export const gradient = (name) =>
  `linear-gradient(to right, ${kStops[name].map((stop) => `#${stop}`).join(", ")})`;

/** The map in 256 steps, as bytes RGBA. */
export function table(name) {
  const bytes = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; ++i) bytes.set([...mapped(name, i / 255), 255], 4 * i);
  return bytes;
}

// Distinct for most colour-blind eyes as well (after Okabe and Ito, and Tol), light enough for both themes.
const kCategories = [
  "0072b2",
  "e69f00",
  "009e73",
  "cc79a7",
  "56b4e9",
  "d55e00",
  "b5a800",
  "8c6bb1",
  "66a61e",
  "a6761d",
  "e7298a",
  "1b9e9e",
];

/** The colour of the i-th category, as [r, g, b] of 255. */
export function category(i) {
  if (i < kCategories.length) return rgbOf(kCategories[i]);
  const hue = (i * 137.508) % 360;
  return hslToRgb(hue, 0.55, i % 2 ? 0.45 : 0.6);
}

function hslToRgb(hue, saturation, lightness) {
  const a = saturation * Math.min(lightness, 1 - lightness);
  return [0, 8, 4].map((n) => {
    const k = (n + hue / 30) % 12;
    return Math.round(255 * (lightness - a * Math.max(-1, Math.min(k - 3, 9 - k, 1))));
  });
}

/** Good, fair, bad of analysis.displacement; nothing for other numbers. */
export const gradeColour = (grade) =>
  ["009e73", "e69f00", "c8322d"].slice(grade, grade + 1).map(rgbOf)[0];

export const css = ([r, g, b]) => `rgb(${r}, ${g}, ${b})`;
export const categoryCss = (i) => css(category(i));

/** What has no number or label. */
export const kNone = [150, 150, 150];
