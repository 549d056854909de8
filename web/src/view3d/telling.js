// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

// Columns that say most about a value, first one first.
const kTelling = [
  /^deviation/,
  /^displacement/,
  /^distance/,
  /^cluster$/,
  /^grade$/,
  /^curvature$/,
  /^label$/,
];

/** The colouring by the column that says most about the value; null where none does. */
export function telling(value) {
  for (const pattern of kTelling) {
    const column = value.columns.find(({ name }) => pattern.test(name));
    if (column) return `column:${column.name}`;
  }
  return null;
}
