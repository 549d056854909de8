// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import { GLSL3 } from "three";

// Where a vertex's colour comes from: uniform `source`.
export const kPlain = 0;
export const kHeight = 1;
export const kNumber = 2;
export const kLabel = 3;

// Shared by points and meshes: raw column entries become a place in the colour table. `affine` takes
// the raw entry (or z) to 0..1 of the legend; labels are ranks, looked up as they are.
const colouring = /* glsl */ `
  uniform int source;
  uniform vec2 affine;
  in float entry;
  out float place;
  flat out float missing;
  void lookUp() {
    missing = 0.0;
    place = 0.0;
    if (source == 1) place = affine.x * position.z + affine.y;
    if (source == 2) {
      missing = entry > 65534.5 ? 1.0 : 0.0;
      place = affine.x * entry + affine.y;
    }
    if (source == 3) place = entry;
  }
`;

const fragmentColour = /* glsl */ `
  precision highp float;
  uniform int source;
  uniform vec3 plain;
  uniform vec3 none;
  uniform float opacity;
  uniform sampler2D table;
  in float place;
  flat in float missing;
  out vec4 outColour;
  // Ordered dither: values under each other show through without being sorted by depth.
  void dither() {
    if (opacity >= 1.0) return;
    int x = int(gl_FragCoord.x) & 3;
    int y = int(gl_FragCoord.y) & 3;
    int m = (((x ^ y) & 1) << 3) | ((y & 1) << 2) | (((x ^ y) & 2)) | ((y & 2) >> 1);
    if (opacity <= (float(m) + 0.5) / 16.0) discard;
  }
  vec3 colour() {
    if (source == 0) return plain;
    if (missing > 0.5) return none;
    if (source == 3) {
      vec4 entry = texelFetch(table, ivec2(int(place + 0.5), 0), 0);
      if (entry.a < 0.5) discard;
      return entry.rgb;
    }
    return texture(table, vec2(clamp(place, 0.0, 1.0) * (255.0 / 256.0) + 0.5 / 256.0, 0.5)).rgb;
  }
`;

export const pointShader = {
  glslVersion: GLSL3,
  vertexShader: /* glsl */ `
    uniform float size;
    ${colouring}
    void main() {
      lookUp();
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      gl_PointSize = size;
    }
  `,
  fragmentShader: /* glsl */ `
    ${fragmentColour}
    void main() {
      vec2 off = gl_PointCoord - 0.5;
      if (dot(off, off) > 0.25) discard;
      dither();
      outColour = vec4(colour(), 1.0);
    }
  `,
};

export const meshShader = {
  glslVersion: GLSL3,
  vertexShader: /* glsl */ `
    ${colouring}
    out vec3 towards;
    out vec3 viewNormal;
    void main() {
      lookUp();
      vec4 seen = modelViewMatrix * vec4(position, 1.0);
      towards = -seen.xyz;
      viewNormal = normalMatrix * normal;
      gl_Position = projectionMatrix * seen;
    }
  `,
  fragmentShader: /* glsl */ `
    ${fragmentColour}
    in vec3 towards;
    in vec3 viewNormal;
    void main() {
      dither();
      vec3 n = normalize(viewNormal);
      vec3 v = normalize(towards);
      if (dot(n, v) < 0.0) n = -n;
      vec3 light = normalize(vec3(-0.35, 0.55, 0.75));
      float lit = 0.42 + 0.58 * max(dot(n, light), 0.0);
      float shine = 0.10 * pow(max(dot(reflect(-light, n), v), 0.0), 24.0);
      outColour = vec4(colour() * lit + shine, 1.0);
    }
  `,
};

// Eye-dome lighting (Boucheny 2009): a pixel is darkened by how much nearer its neighbours are, which
// shows the form of a cloud that has no normals.
export const domeShader = {
  glslVersion: GLSL3,
  vertexShader: /* glsl */ `
    out vec2 at;
    void main() {
      at = uv;
      gl_Position = vec4(position.xy, 0.0, 1.0);
    }
  `,
  fragmentShader: /* glsl */ `
    precision highp float;
    uniform sampler2D image;
    uniform highp sampler2D depth;
    uniform vec2 pixel;
    uniform vec2 nearFar;
    uniform float strength;
    in vec2 at;
    out vec4 outColour;
    float logDepth(vec2 place) {
      float d = texture(depth, place).r;
      if (d >= 1.0) return 1e3;
      return log2(nearFar.x * nearFar.y / (nearFar.y - d * (nearFar.y - nearFar.x)));
    }
    void main() {
      vec4 c = texture(image, at);
      float here = logDepth(at);
      if (here < 1e3 && strength > 0.0) {
        float sum = 0.0;
        for (int i = 0; i < 8; ++i) {
          float angle = 0.785398 * float(i);
          float there = logDepth(at + vec2(cos(angle), sin(angle)) * pixel);
          if (there < 1e3) sum += max(0.0, here - there);
        }
        c.rgb *= 0.25 + 0.75 * exp(-strength * sum / 8.0);
      }
      outColour = c;
    }
  `,
};
