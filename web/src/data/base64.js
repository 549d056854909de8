// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

/** The bytes of base64 text as an ArrayBuffer. */
export function bytesOf(text) {
  const clean = text.trim();
  if (typeof Uint8Array.fromBase64 === "function") return Uint8Array.fromBase64(clean).buffer;
  const binary = atob(clean);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes.buffer;
}
