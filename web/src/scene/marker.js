/** The joint that a reason names: a red ring round it and its name as the reason says it, while the motion is stopped. */

import { blamed } from "../solver/motion.js";
import { configurationAt } from "../solver/configuration.js";
import { placed } from "../solver/rotation.js";
import { drawnSmall, halo, onScreen, paint, resize, sprite, written } from "./sprites.js";

const RING = 34; // pixels
const NAME = 29;
const RED = (dark) => (dark ? "#ff8a80" : "#c62828");

const circle = (colour, around) =>
  drawnSmall(96, 96, (context) => {
    context.arc(48, 48, 38, 0, 2 * Math.PI);
    for (const [strokeStyle, lineWidth] of [[around, 16], [colour, 9]])
      Object.assign(context, { strokeStyle, lineWidth }).stroke();
  });

export class Marker {
  constructor(model, group) {
    Object.assign(this, { model, dark: false, name: null, ring: sprite(11), label: sprite(12) });
    this.label.center.set(-0.25, -0.3);
    group.add(this.ring, this.label);
    this.show(null);
  }

  paint(dark) {
    Object.assign(this, { dark, name: null });
    paint(this.ring, circle(RED(dark), halo(dark)));
  }

  /** @param {import("../solver/motion.js").Reason|null} reason @param {number[]} values */
  show(reason, values) {
    const joint = blamed(this.model, reason);
    this.ring.visible = this.label.visible = Boolean(joint);
    if (!joint) return;
    const { frames } = configurationAt(this.model, values);
    for (const item of [this.ring, this.label]) item.position.set(...placed(frames[joint.parent], joint.at));
    if (this.name === reason.joint) return;
    this.name = reason.joint;
    paint(this.label, written(/^(.*?)(\d*)$/.exec(this.name).slice(1), RED(this.dark), halo(this.dark)));
  }

  /** For a picture of so many pixels, in the group's own scale. @returns {number[][]} the places that it takes */
  arrange(camera, width, height, scale) {
    if (!this.ring.visible) return [];
    resize(this.ring, RING, camera, height, scale);
    resize(this.label, NAME, camera, height, scale);
    return [onScreen(this.ring, camera, width, height)];
  }
}
