/** The joint that a reason names: a red ring round it and its name as the reason says it, while the motion is stopped. */

import { blamed } from "../solver/motion.js";
import { configurationAt } from "../solver/configuration.js";
import { placed } from "../solver/rotation.js";
import { halo, onScreen, sprite, spriteSize, textureOf, written } from "./letters.js";

const RING = 34; // pixels
const NAME = 29;
const RED = (dark) => (dark ? "#ff8a80" : "#c62828");

function circle(colour, around) {
  const canvas = Object.assign(document.createElement("canvas"), { width: 96, height: 96 });
  const context = canvas.getContext("2d");
  for (const [style, width] of [
    [around, 16],
    [colour, 9],
  ]) {
    context.strokeStyle = style;
    context.lineWidth = width;
    context.beginPath();
    context.arc(48, 48, 38, 0, 2 * Math.PI);
    context.stroke();
  }
  return canvas;
}

export class Marker {
  constructor(model, group) {
    Object.assign(this, { model, dark: false, name: null, ring: sprite(11), label: sprite(12) });
    this.label.center.set(-0.25, -0.3);
    group.add(this.ring, this.label);
    this.show(null);
  }

  paint(dark) {
    this.dark = dark;
    this.ring.material.map?.dispose();
    this.ring.material.map = textureOf(circle(RED(dark), halo(dark)));
    this.ring.material.needsUpdate = true;
    this.name = null;
  }

  /** @param {import("../solver/motion.js").Reason|null} reason @param {number[]} values */
  show(reason, values) {
    const joint = blamed(this.model, reason);
    this.ring.visible = this.label.visible = Boolean(joint);
    if (!joint) return;
    const { frames } = configurationAt(this.model, values);
    for (const item of [this.ring, this.label]) item.position.set(...placed(frames[joint.parent], joint.at));
    if (this.name !== reason.joint) this.write(reason.joint);
  }

  write(name) {
    this.name = name;
    const canvas = written(/^(.*?)(\d*)$/.exec(name).slice(1), RED(this.dark), halo(this.dark));
    this.label.material.map?.dispose();
    this.label.material.map = textureOf(canvas);
    this.label.material.needsUpdate = true;
    this.shape = canvas.width / canvas.height;
  }

  /** For a picture of so many pixels, in the group's own scale. @returns {number[][]} the places that it takes */
  arrange(camera, width, height, scale) {
    if (!this.ring.visible) return [];
    this.ring.scale.setScalar(spriteSize(RING, camera, height, scale));
    const size = spriteSize(NAME, camera, height, scale);
    this.label.scale.set(size * this.shape, size, 1);
    return [onScreen(this.ring, camera, width, height)];
  }
}
