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
    const material = new THREE.ShaderMaterial({ ...domeShader, uniforms: this.uniforms, depthTest: false, depthWrite: false, blending: THREE.NoBlending });
    this.scene = new THREE.Scene();
    this.scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material));
    this.scene.children[0].frustumCulled = false;
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
  }

  resize(width, height) {
    this.target?.dispose();
    const depthTexture = new THREE.DepthTexture(width, height, THREE.UnsignedIntType);
    this.target = new THREE.WebGLRenderTarget(width, height, { samples: 4, depthTexture });
    this.size = [width, height];
  }

  render(scene, camera, ratio) {
    const { renderer, uniforms } = this;
    renderer.setRenderTarget(this.target);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    uniforms.image.value = this.target.texture;
    uniforms.depth.value = this.target.depthTexture;
    uniforms.pixel.value.set((1.3 * ratio) / this.size[0], (1.3 * ratio) / this.size[1]);
    uniforms.nearFar.value.set(camera.near, camera.far);
    uniforms.strength.value = this.strength;
    renderer.clear();
    renderer.render(this.scene, this.camera);
  }
}
