/** The other assembly modes: translucent bodies that follow the inputs; a click makes one current. */

import { Raycaster, Vector2 } from "three";
import { minus } from "./dom.js";
import { body } from "./scene/links.js";

/** Colours that colour-blind readers tell apart (after Okabe and Ito). */
export const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#7b61c9", "#8c8c2a"];
const MANY = 9; // more than so many hide the mechanism, and each other
const BUDGET = 10; // milliseconds of a picture that ghosts may take

export class Ghosts {
  /** @param {import("three").Group} current the mechanism itself, which hides what is behind it */
  constructor(mechanism, geometries, stage, current) {
    const most = Math.max(mechanism.assembly.length, ...mechanism.working.map((item) => item.assembly?.length ?? 0));
    Object.assign(this, { mechanism, stage, shown: mechanism.assembly.length <= MANY, waiting: [], lit: -1 });
    this.bodies = Array.from({ length: most }, (_, k) => {
      const ghost = body(mechanism.model, geometries, { ghost: COLOURS[k % COLOURS.length], behind: 1 + (k % COLOURS.length) });
      ghost.group.traverse((part) => (part.userData.branch = k));
      ghost.group.visible = false; // until it is placed
      stage.add(ghost.group);
      return ghost;
    });
    this.groups = this.bodies.map(({ group }) => group);
    this.solid = [current, ...this.groups];
    this.follow();
    mechanism.listen(() => this.follow());
    this.pick();
  }

  /** Queues every ghost for the new inputs; as many as time allows are moved before each picture. */
  follow() {
    const { assembly, branch } = this.mechanism;
    this.groups.forEach((group, k) => {
      if (!this.shown || k === branch || k >= assembly.length) group.visible = false;
    });
    this.waiting = this.shown ? [...assembly.keys()].filter((k) => k !== branch) : [];
    this.stage.invalidate();
  }

  advance() {
    if (!this.waiting.length) return;
    const start = performance.now();
    while (this.waiting.length && performance.now() - start < BUDGET) {
      const k = this.waiting.shift();
      const { group, place } = this.bodies[k];
      group.visible = this.mechanism.follow(k);
      if (group.visible) place(this.mechanism.assembly[k].values);
    }
    if (this.waiting.length) requestAnimationFrame(() => this.stage.invalidate());
    else {
      this.stage.stirred();
      this.done?.();
    }
  }

  show(shown) {
    this.shown = shown;
    this.stage.keep(this.groups, shown);
    this.follow();
  }

  /** The ghost under the pointer, -1 where there is none. */
  under(event) {
    const { left, top, width, height } = this.stage.canvas.getBoundingClientRect();
    const at = new Vector2((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height);
    const ray = new Raycaster();
    ray.setFromCamera(at, this.stage.view.camera);
    const [hit] = ray.intersectObjects(this.solid.filter(({ visible }) => visible));
    return hit?.object.userData.branch ?? -1;
  }

  pick() {
    const { canvas } = this.stage;
    let pressed = null;
    canvas.addEventListener("pointerdown", (event) => (pressed = [event.clientX, event.clientY]));
    canvas.addEventListener("pointerup", (event) => {
      if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 5) return;
      const k = this.under(event);
      if (k >= 0) this.mechanism.choose(k);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!event.buttons && event.pointerType !== "touch") this.light(this.under(event));
    });
    canvas.addEventListener("pointerleave", () => this.light(-1));
  }

  /** Shows one ghost more strongly. */
  light(index) {
    if (index === this.lit) return;
    const { shown, bodies, groups, mechanism } = this;
    const { canvas } = this.stage;
    if (!shown && groups[this.lit]) groups[this.lit].visible = false;
    this.lit = index;
    if (!shown && mechanism.assembly[index] && index !== mechanism.branch && mechanism.follow(index)) {
      groups[index].visible = true;
      bodies[index].place(mechanism.assembly[index].values);
    }
    bodies.forEach(({ tint }, k) => (tint.opacity = k === index ? 0.65 : 0.3));
    canvas.style.cursor = index >= 0 ? "pointer" : "";
    canvas.title = index >= 0 ? `${minus(mechanism.assembly[index].label)}: click to make it current` : "";
    this.stage.invalidate();
  }
}
