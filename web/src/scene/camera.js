/** The camera: it looks at the mechanism with Z up, is turned by mouse or touch, and can be said in a few numbers. */

import { Box3, PerspectiveCamera, Spherical, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const MARGIN = 1.16;
const UP_TO_Y = ([x, y, z]) => new Vector3(x, z, -y);

export class Camera {
  /** @param {HTMLElement} element that takes the mouse @param {() => void} changed */
  constructor(element, changed, calm) {
    this.camera = new PerspectiveCamera(30, 1, 0.02, 60);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, element);
    Object.assign(this.controls, {
      enableDamping: !calm,
      dampingFactor: 0.12,
      minDistance: 0.3,
      maxDistance: 20,
      zoomToCursor: true,
    });
    this.controls.addEventListener("change", changed);
    this.about([new Vector3()]);
  }

  /** What must be seen. @param {Vector3[]} points */
  about(points) {
    this.points = points;
    this.centre = new Box3().setFromPoints(points).getCenter(new Vector3());
  }

  /** Looks from an azimuth and an elevation in degrees, from as near as everything can be seen. */
  look(azimuth = -52, elevation = 24) {
    this.put(azimuth, elevation, 1, this.centre);
    this.camera.updateMatrixWorld();
    const up = Math.tan((this.camera.fov * Math.PI) / 360) / MARGIN;
    const aside = up * this.camera.aspect;
    const at = new Vector3();
    const needed = this.points.map((point) => {
      at.copy(point).applyMatrix4(this.camera.matrixWorldInverse);
      return at.z + 1 + Math.max(Math.abs(at.x) / aside, Math.abs(at.y) / up);
    });
    this.put(azimuth, elevation, Math.max(0.3, ...needed), this.centre);
  }

  put(azimuth, elevation, distance, target) {
    const [a, e] = [azimuth, Math.max(-89.99, Math.min(89.99, elevation))].map((angle) => (angle * Math.PI) / 180);
    this.controls.target.copy(target);
    this.camera.position
      .set(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e))
      .multiplyScalar(distance)
      .add(target);
    this.controls.update();
  }

  /** Pictures that are higher than wide are seen from further away; distances are said as if they were not. */
  get narrow() {
    return Math.min(1, this.camera.aspect);
  }

  /** @param {number[]} numbers azimuth, elevation, distance, target x, y, z */
  set([azimuth, elevation, distance, x, y, z]) {
    this.put(azimuth, elevation, distance / this.narrow, new Vector3(x, y, z));
  }

  /** The same numbers of where it is now. */
  numbers() {
    const way = this.camera.position.clone().sub(this.controls.target);
    const { radius, phi, theta } = new Spherical().setFromVector3(UP_TO_Y(way.toArray()));
    const azimuth = (theta * 180) / Math.PI - 90;
    return [
      ((azimuth + 540) % 360) - 180,
      90 - (phi * 180) / Math.PI,
      radius * this.narrow,
      ...this.controls.target.toArray(),
    ];
  }

  resize(width, height) {
    const numbers = this.numbers();
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.set(numbers);
  }
}
