/**
 * The camera: it looks at the mechanism with Z up, is turned by mouse or touch, can be said in a few numbers, and goes
 * to where given points are seen.
 */

import { Box3, PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const MARGIN = 1.16;
const EASE = 110; // milliseconds in which a way shrinks to a third
const [NEAREST, FURTHEST] = [0.3, 20];
const RADIAN = Math.PI / 180;

export class Camera {
  /** @param {HTMLElement} element that takes the mouse @param {() => void} changed @param {boolean} calm */
  constructor(element, changed, calm) {
    Object.assign(this, { calm, changed, hand: false, held: false, given: false, goal: null, time: 0 });
    this.camera = new PerspectiveCamera(30, 1, 0.02, 60);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, element);
    const distances = { minDistance: NEAREST, maxDistance: FURTHEST, zoomToCursor: true };
    Object.assign(this.controls, { enableDamping: !calm, dampingFactor: 0.12, ...distances });
    this.controls.addEventListener("start", () => {
      this.held = true;
      this.goal = null;
    });
    this.controls.addEventListener("end", () => (this.held = false));
    this.controls.addEventListener("change", () => {
      if (this.held) this.hand = true; // from now on it is the reader's view
      changed();
    });
  }

  /** Looks from an azimuth and an elevation in degrees, from as near as all points can be seen. */
  look(points, azimuth, elevation) {
    const { distance, target } = this.seeing(points, azimuth, elevation);
    this.put(azimuth, elevation, distance, target);
    Object.assign(this, { hand: false, goal: null });
  }

  /** Goes to where all points are seen from the same side, smoothly unless that is not wanted. */
  glide(points) {
    const [azimuth, elevation] = this.numbers();
    this.hand = false;
    if (this.calm) return this.look(points, azimuth, elevation);
    if (!this.goal) this.time = performance.now();
    this.goal = { azimuth, elevation, ...this.seeing(points, azimuth, elevation) };
    this.changed();
  }

  /** One picture's part of that way. */
  advance() {
    if (!this.goal) return;
    const { azimuth, elevation, distance, target } = this.goal;
    const now = performance.now();
    const left = Math.exp((this.time - now) / EASE);
    this.time = now;
    const away = this.controls.target.clone().sub(target).multiplyScalar(left);
    const longer = this.camera.position.distanceTo(this.controls.target) - distance;
    const near = Math.abs(longer * left) + away.length() < 1e-3 * distance;
    this.put(azimuth, elevation, near ? distance : distance + longer * left, near ? target : away.add(target));
    if (!near) return this.changed();
    this.goal = null;
    this.controls.dispatchEvent({ type: "end" }); // as when a reader has turned it
  }

  /** From how far, and at what, it must look. @param {Vector3[]} points */
  seeing(points, azimuth, elevation) {
    const target = new Box3().setFromPoints(points).getCenter(new Vector3());
    const way = towards(azimuth, elevation);
    const aside = new Vector3(-Math.sin(azimuth * RADIAN), Math.cos(azimuth * RADIAN), 0);
    const up = new Vector3().crossVectors(way, aside);
    const high = Math.tan((this.camera.fov * RADIAN) / 2) / MARGIN;
    const wide = high * this.camera.aspect;
    const at = new Vector3();
    const needed = points.map((point) => {
      at.subVectors(point, target);
      return at.dot(way) + Math.max(Math.abs(at.dot(aside)) / wide, Math.abs(at.dot(up)) / high);
    });
    return { target, distance: Math.min(FURTHEST, Math.max(NEAREST, ...needed)) };
  }

  /** How many of the points are in the picture. @param {Vector3[]} points */
  seen(points) {
    this.camera.updateMatrixWorld();
    const at = new Vector3();
    return points.filter((point) => {
      at.copy(point).project(this.camera);
      return Math.abs(at.x) <= 1 && Math.abs(at.y) <= 1 && Math.abs(at.z) <= 1;
    }).length;
  }

  put(azimuth, elevation, distance, target) {
    this.controls.target.copy(target);
    this.camera.position.copy(towards(azimuth, elevation)).multiplyScalar(distance).add(target);
    this.controls.update();
  }

  /** Pictures that are higher than wide are seen from further away; distances are said as if they were not. */
  get narrow() {
    return Math.min(1, this.camera.aspect);
  }

  /** A view from a link: the reader's own where it leaves something out. @param {number[]} numbers azimuth, elevation, distance, target x, y, z */
  set(numbers) {
    this.restore(numbers);
    Object.assign(this, { given: true, goal: null });
  }

  restore([azimuth, elevation, distance, x, y, z]) {
    this.put(azimuth, elevation, distance / this.narrow, new Vector3(x, y, z));
  }

  /** The same numbers of where it is now. */
  numbers() {
    const { target } = this.controls;
    const [x, y, z] = this.camera.position.clone().sub(target);
    const angles = [Math.atan2(y, x), Math.atan2(z, Math.hypot(x, y))];
    return [...angles.map((angle) => angle / RADIAN), Math.hypot(x, y, z) * this.narrow, ...target];
  }

  resize(width, height) {
    const numbers = this.numbers();
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.restore(numbers);
  }
}

/** The unit vector from what is looked at to the camera. */
function towards(azimuth, elevation) {
  const [a, e] = [azimuth, Math.max(-89.99, Math.min(89.99, elevation))].map((angle) => angle * RADIAN);
  return new Vector3(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e));
}
