/** The stage: renderer, light with soft shadows, floor, and one picture whenever something has changed. */

import * as THREE from "three";
import { Camera } from "./camera.js";
import { outline } from "./outline.js";
import { drawn } from "./sprites.js";

/** Azimuth and elevation of the usual view, in degrees. */
export const SPACE = [-52, 24];

const [LATE, STILL, MANY] = [70, 400, 12]; // milliseconds from picture to picture; so many late ones leave shadows out

const LOOKS = {
  light: { top: "#ffffff", bottom: "#dfe6ee", grid: "rgba(60,80,100,.30)", shadow: 0.24, sky: 2.0, sun: 2.0 },
  dark: { top: "#232a33", bottom: "#0e1217", grid: "rgba(170,195,220,.22)", shadow: 0.55, sky: 1.3, sun: 1.8 },
};

export class Stage {
  constructor(element, { dark, calm }) {
    this.element = element;
    this.renderer = new THREE.WebGLRenderer({ antialias: true });
    this.slow = drawnByProcessor(this.renderer.getContext());
    Object.assign(this.renderer, { toneMapping: THREE.NeutralToneMapping, toneMappingExposure: 1.12 });
    // the sun stands; only what moves changes shadows
    Object.assign(this.renderer.shadowMap, { enabled: true, type: THREE.PCFShadowMap, autoUpdate: false });
    this.canvas = this.renderer.domElement;
    this.canvas.addEventListener("webglcontextrestored", () => this.moved());
    element.prepend(this.canvas);
    this.scene = new THREE.Scene();
    this.root = new THREE.Group(); // the mechanism in its own unit, scaled so that it is about 1 large
    this.scene.add(this.root);
    this.before = []; // called before each picture
    this.objects = []; // the mechanism, its ghosts and layers: what a view can be fitted to
    this.kept = new Set(); // what is to stay in the picture: the mechanism, and what somebody switched on
    this.view = new Camera(this.canvas, () => this.invalidate(), calm);
    this.light();
    this.floor();
    this.setDark(dark);
    new ResizeObserver(() => this.resize()).observe(element);
  }

  /** Sky and ground from all sides, a sun with shadows, and two lights that round off what it leaves dark. */
  light() {
    this.sky = new THREE.HemisphereLight("#ffffff", "#c9d0da", 1);
    this.sky.position.set(0, 0, 1);
    this.sun = new THREE.DirectionalLight("#fff4e4", 1);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.setScalar(this.slow ? 1024 : 2048);
    Object.assign(this.sun.shadow, { radius: this.slow ? 2 : 3.5, bias: -0.0004, normalBias: 0.006 });
    const [fill, rim] = [new THREE.DirectionalLight("#e6eeff", 1.0), new THREE.DirectionalLight("#ffffff", 0.9)];
    fill.position.set(1.5, -0.6, 0.5);
    rim.position.set(-0.4, 1.2, 0.5);
    this.scene.add(this.sky, this.sun, this.sun.target, fill, rim);
  }

  /** Puts an object into the mechanism's own space. */
  add(object) {
    this.root.add(object);
    this.objects.push(object);
  }

  /** Scales what is drawn, lays the floor under it, and has camera and sun see all of it. @param {number} extent */
  frame(group, extent) {
    this.scale = 1 / extent;
    this.root.scale.setScalar(this.scale);
    this.kept.add(group);
    const points = outline(group);
    const { centre, radius } = this.shine(points);
    const level = Math.min(...points.map((point) => point.z)) - 0.012;
    for (const [mesh, size] of [[this.lines, 9], [this.shade, 5]]) {
      mesh.position.set(centre.x, centre.y, level);
      mesh.scale.setScalar(size * radius);
    }
  }

  /** Turns the sun to points, so that all of them have shadows. @returns {{centre: THREE.Vector3, radius: number}} */
  shine(points) {
    const seen = new THREE.Box3().setFromPoints(points);
    const centre = seen.getCenter(new THREE.Vector3());
    const radius = seen.getSize(new THREE.Vector3()).length() / 2;
    this.sun.position.copy(centre).add(new THREE.Vector3(-0.55, -0.75, 1.5).multiplyScalar(2.2 * radius));
    this.sun.target.position.copy(centre);
    const [low, high] = [-1.5 * radius, 1.5 * radius];
    Object.assign(this.sun.shadow.camera, { left: low, right: high, bottom: low, top: high, near: 0.1, far: 9 * radius });
    this.sun.shadow.camera.updateProjectionMatrix();
    this.renderer.shadowMap.needsUpdate = true;
    return { centre, radius };
  }

  /** Looks at everything that is shown, from an azimuth and an elevation in degrees. */
  look([azimuth, elevation] = SPACE) {
    this.view.look(this.outlines(this.objects), azimuth, elevation);
  }

  outlines(objects, moving = false) {
    return [...objects].filter((object) => object.visible).flatMap((object) => outline(object, moving));
  }

  /** Objects that somebody switched on, or off: they stay in the picture from now on, or need no longer. */
  keep(objects, on) {
    for (const object of objects) on ? this.kept.add(object) : this.kept.delete(object);
    this.stirred();
  }

  /** Goes after what has left the picture; a reader's own view is left alone as long as it shows anything that moves. */
  follow() {
    this.view.advance();
    if (!this.left || this.view.held) return;
    this.left = false;
    const points = this.outlines(this.kept);
    const whole = this.view.seen(points) === points.length;
    if (this.view.given) Object.assign(this.view, { given: false, hand: !whole });
    if (this.view.hand ? this.view.seen(this.outlines(this.kept, true)) > 0 : whole) return;
    this.shine(points);
    this.view.glide(points);
  }

  /** Lines, and what takes shadows. */
  floor() {
    const look = { transparent: true, depthWrite: false, toneMapped: false };
    const plane = new THREE.PlaneGeometry(1, 1);
    this.lines = new THREE.Mesh(plane, new THREE.MeshBasicMaterial(look));
    this.shade = new THREE.Mesh(plane, new THREE.ShadowMaterial({ depthWrite: false }));
    this.shade.receiveShadow = true;
    this.lines.renderOrder = this.shade.renderOrder = -1;
    this.scene.add(this.lines, this.shade);
  }

  setDark(dark) {
    this.colours = dark ? LOOKS.dark : LOOKS.light;
    this.scene.background = gradient(this.colours);
    this.sky.intensity = this.colours.sky;
    this.sun.intensity = this.colours.sun;
    this.shade.material.opacity = this.colours.shadow;
    this.lines.material.map = grid(this.colours.grid, this.slow ? 2 : 8);
    this.lines.material.needsUpdate = true;
    this.invalidate();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(this.slow ? 1 : 2, window.devicePixelRatio || 1));
    this.renderer.setSize(width, height, false);
    this.view.resize(width, height);
    this.stirred();
  }

  /** Asks for a picture in which something has moved. */
  moved() {
    this.renderer.shadowMap.needsUpdate = true;
    this.stirred();
  }

  /** Asks for a picture before which it is looked whether anything has left it. */
  stirred() {
    this.left = true;
    this.invalidate();
  }

  /** Asks for a picture; several wishes make one. */
  invalidate() {
    if (this.asked) return;
    this.asked = requestAnimationFrame(() => {
      this.asked = 0;
      this.view.controls.update();
      this.draw();
    });
  }

  draw() {
    for (const call of this.before) call();
    this.renderer.render(this.scene, this.view.camera);
    const now = performance.now();
    const between = now - (this.last ?? now);
    this.last = now;
    if (between < STILL) this.late = between > LATE ? (this.late ?? 0) + 1 : 0; // one after the other
    if (this.late > MANY) this.canvas.dataset.shadows = this.sun.castShadow = false; // what moves is worth more
  }

  /** The picture as PNG. @returns {Promise<Blob>} */
  picture() {
    this.draw();
    return new Promise((done) => this.canvas.toBlob(done, "image/png"));
  }
}

/** Whether there is no graphics card, and pictures must be cheap. */
function drawnByProcessor(context) {
  const info = context.getExtension("WEBGL_debug_renderer_info");
  const name = info ? context.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

const gradient = ({ top, bottom }) =>
  drawn(2, 256, (context) => {
    context.fillStyle = context.createLinearGradient(0, 0, 0, 256);
    context.fillStyle.addColorStop(0, top);
    context.fillStyle.addColorStop(1, bottom);
    context.fillRect(0, 0, 2, 256);
  });

/** Thin lines that fade away from the middle. */
function grid(colour, anisotropy) {
  const size = 1024;
  const draw = (context) => {
    context.fillStyle = colour;
    for (let k = 1; k < 36; k++) {
      const at = (k * size) / 36 - 0.75;
      context.globalAlpha = k % 3 === 0 ? 1 : 0.45;
      context.fillRect(at, 0, 1.5, size);
      context.fillRect(0, at, size, 1.5);
    }
    context.globalAlpha = 1;
    context.globalCompositeOperation = "destination-in";
    context.fillStyle = context.createRadialGradient(size / 2, size / 2, 0, size / 2, size / 2, size / 2);
    context.fillStyle.addColorStop(0.1, "rgba(0,0,0,1)");
    context.fillStyle.addColorStop(0.85, "rgba(0,0,0,0)");
    context.fillRect(0, 0, size, size);
  };
  return drawn(size, size, draw, { anisotropy });
}
