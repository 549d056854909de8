// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// A 3-D view: camera, layers, drawing on demand. What it does to a page is its canvas and its marks.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { h } from "../dom.js";
import { onTheme } from "../plots/theme.js";
import { Detail } from "./detail.js";
import { Dome } from "./dome.js";
import { Grid } from "./grid.js";
import { bindKeys } from "./keys.js";
import { Marks } from "./marks.js";
import { pick } from "./pick.js";

const kManyPoints = 150000;
const kStill = 4; // pixels: a pointer that moves less has clicked

export class View {
  /** `base`: the point of the world that is the view's origin [m]; views with linked cameras share it. */
  constructor(base, label) {
    this.base = base;
    this.layers = [];
    this.listeners = { pick: [], camera: [] };
    this.canvas = h("canvas", {
      tabindex: "0",
      role: "application",
      "aria-label": label,
      "aria-roledescription": "3-D view",
    });
    this.element = h("div", { class: "view" }, this.canvas);
    this.renderer = new THREE.WebGLRenderer({
      canvas: this.canvas,
      alpha: true,
      antialias: false,
      preserveDrawingBuffer: true,
    });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.setClearColor(0x000000, 0);
    this.renderer.autoClear = false;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.01, 1000);
    this.camera.up.set(0, 0, 1);
    this.dome = new Dome(this.renderer);
    this.grid = new Grid(this.scene);
    this.marks = new Marks(this.element, base);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener("change", () => this.#moved());
    this.#bindPointer();
    bindKeys(this);
    new ResizeObserver(() => this.draw()).observe(this.element);
    onTheme(() => this.drawNow());
    this.radius = 1;
    this.detail = new Detail(() => this.draw());
  }

  on(event, listener) {
    this.listeners[event].push(listener);
  }

  add(layer) {
    this.layers.push(layer);
    this.scene.add(layer.object);
    this.draw();
  }

  remove(layer) {
    this.layers = this.layers.filter((one) => one !== layer);
    this.scene.remove(layer.object);
    layer.dispose();
    this.draw();
  }

  /** Anything else to draw, placed relative to `base`. */
  addObject(object) {
    this.scene.add(object);
    this.draw();
  }

  /** The box around what is visible, relative to `base`; null where nothing is. */
  box() {
    const shown = this.layers.filter((layer) => layer.visible);
    if (shown.length === 0) return null;
    const box = new THREE.Box3();
    for (const layer of shown) {
      const [lo, hi] = layer.value.bounds();
      box.expandByPoint(this.relative(lo)).expandByPoint(this.relative(hi));
    }
    return box;
  }

  relative(point) {
    return new THREE.Vector3(...point.map((x, axis) => x - this.base[axis]));
  }

  /**
   * Looks at all that is visible, and at `more` points, from `direction` (towards the camera), else from
   * where it looks now.
   */
  fit(direction, more = []) {
    const box =
      this.box() ?? new THREE.Box3(new THREE.Vector3(-1, -1, -1), new THREE.Vector3(1, 1, 1));
    for (const point of more) box.expandByPoint(this.relative(point));
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    this.radius = Math.max(sphere.radius, 1e-6);
    const towards = direction
      ? new THREE.Vector3(...direction).normalize()
      : this.camera.position.clone().sub(this.controls.target).normalize();
    if (towards.lengthSq() === 0) towards.set(1, -1, 0.5).normalize();
    const half = THREE.MathUtils.degToRad(this.camera.fov / 2);
    const narrow = Math.min(1, this.camera.aspect);
    const distance = (this.radius / Math.sin(Math.atan(Math.tan(half) * narrow))) * 0.92;
    this.controls.target.copy(sphere.center);
    this.camera.position.copy(sphere.center).addScaledVector(towards, distance);
    this.grid.place(box, this.base);
    this.placing = true;
    this.controls.update();
    this.#moved();
    this.placing = false;
  }

  /** The ground follows what is visible. */
  layersChanged() {
    const box = this.box();
    if (box) this.grid.place(box, this.base);
    this.draw();
  }

  pose() {
    return {
      position: this.camera.position.clone(),
      target: this.controls.target.clone(),
      radius: this.radius,
    };
  }

  /** Takes another view's camera without telling the listeners. */
  follow(pose) {
    this.following = true;
    this.camera.position.copy(pose.position);
    this.controls.target.copy(pose.target);
    this.radius = pose.radius;
    this.controls.update();
    this.following = false;
    this.draw();
  }

  #moved() {
    if (!this.placing && this.detail) this.detail.moved();
    this.draw();
    if (!this.following) for (const listener of this.listeners.camera) listener(this.pose());
  }

  /** Draws in the next frame, however often it is asked. */
  draw() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame((now) => {
      this.asked = false;
      this.drawNow(this.detail.frame(now));
    });
  }

  drawNow({ smooth, share } = { smooth: true, share: 1 }) {
    const width = this.element.clientWidth;
    const height = this.element.clientHeight;
    if (width === 0 || height === 0) return;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    if (this.width !== width || this.height !== height || this.ratio !== ratio) {
      Object.assign(this, { width, height, ratio });
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(width, height, false);
      this.dome.resize(width * ratio, height * ratio);
      this.camera.aspect = width / height;
    }
    const away = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = Math.max(away, this.radius) * 1e-3;
    this.camera.far = away + this.radius * 40;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    for (const layer of this.layers) {
      layer.uniforms.size.value = layer.size * ratio;
      layer.setShare(share);
    }
    this.dome.render(this.scene, this.camera, ratio, smooth && this.#worthSmoothing());
    this.marks.place(this.camera, width, height);
  }

  /** Smooth edges are seen on meshes and lines; in large clouds they cost much and show little. */
  #worthSmoothing() {
    const shown = this.layers.filter((layer) => layer.visible);
    const points = shown.reduce(
      (sum, layer) => sum + (layer.value.isMesh() ? 0 : layer.value.shown),
      0,
    );
    return points < kManyPoints;
  }

  /** Picks at pixel (x, y) of the view and tells the listeners. Returns what they were told. */
  pickAt(x, y) {
    this.camera.updateMatrixWorld();
    const found = pick(
      this.layers,
      this.camera,
      x,
      y,
      this.element.clientWidth,
      this.element.clientHeight,
    );
    for (const listener of this.listeners.pick) listener(found);
    return found;
  }

  /** Where a point of the world is on the view, in pixels. */
  project(point) {
    const at = this.relative(point).project(this.camera);
    return {
      x: ((at.x + 1) / 2) * this.element.clientWidth,
      y: ((1 - at.y) / 2) * this.element.clientHeight,
      visible: at.z < 1,
    };
  }

  #bindPointer() {
    let start = null;
    this.canvas.addEventListener("pointerdown", (event) => {
      start =
        event.button === 0 && !event.shiftKey && !event.ctrlKey
          ? { x: event.clientX, y: event.clientY }
          : null;
    });
    this.canvas.addEventListener("pointerup", (event) => {
      if (!start || Math.hypot(event.clientX - start.x, event.clientY - start.y) > kStill) return;
      const box = this.canvas.getBoundingClientRect();
      this.pickAt(event.clientX - box.left, event.clientY - box.top);
    });
    this.canvas.addEventListener("dblclick", (event) => {
      const box = this.canvas.getBoundingClientRect();
      const found = pick(
        this.layers,
        this.camera,
        event.clientX - box.left,
        event.clientY - box.top,
        box.width,
        box.height,
      );
      if (!found) return;
      this.controls.target.copy(this.relative(found.layer.value.point(found.index)));
      this.controls.update();
      this.#moved();
    });
  }

  /** The picture as it is, as a PNG. */
  picture() {
    this.drawNow();
    return this.canvas.toDataURL("image/png");
  }
}
