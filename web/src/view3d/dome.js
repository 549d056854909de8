// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
import * as THREE from "three";
import { domeShader } from "./shaders.js";

/** Draws a scene with eye-dome lighting, through a picture with depth. */
export class Dome {
  constructor(renderer) {
    this.renderer = renderer;
    this.strength = 60;
    this.uniforms = {
      image: { value: null },
      depth: { value: null },
      pixel: { value: new THREE.Vector2() },
      nearFar: { value: new THREE.Vector2() },
      strength: { value: this.strength },
    };
    const material = new THREE.ShaderMaterial({
      ...domeShader,
      uniforms: this.uniforms,
      depthTest: false,
      depthWrite: false,
      blending: THREE.NoBlending,
    });
    this.scene = new THREE.Scene();
    this.scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material));
    this.scene.children[0].frustumCulled = false;
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
  }

  resize(width, height) {
    for (const target of Object.values(this.targets ?? {})) target.dispose();
    this.targets = {};
    this.size = [width, height];
  }

  /** The picture to draw into, with smoothed edges or without. */
  #target(smooth) {
    const [width, height] = this.size;
    this.targets[smooth] ??= new THREE.WebGLRenderTarget(width, height, {
      samples: smooth ? 4 : 0,
      depthTexture: new THREE.DepthTexture(width, height, THREE.UnsignedIntType),
    });
    return this.targets[smooth];
  }

  render(scene, camera, ratio, smooth) {
    const { renderer, uniforms } = this;
    const target = this.#target(smooth);
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    uniforms.image.value = target.texture;
    uniforms.depth.value = target.depthTexture;
    uniforms.pixel.value.set((1.3 * ratio) / this.size[0], (1.3 * ratio) / this.size[1]);
    uniforms.nearFar.value.set(camera.near, camera.far);
    uniforms.strength.value = this.strength;
    renderer.clear();
    renderer.render(this.scene, this.camera);
  }
}
