/** Letters of points and joints beside their points, none over another; round the joint that a reason names a red ring, and
 * its name as the reason says it, while the motion is stopped. */

import { letterOf } from "../dom.js";
import { configurationAt } from "../solver/configuration.js";
import { blamed } from "../solver/motion.js";
import { placed } from "../solver/rotation.js";
import { drawnSmall, halo, onScreen, paint, resize, sprite, written } from "./sprites.js";

const RED = (dark) => (dark ? "#ff8a80" : "#c62828");
const INK = (dark) => (dark ? "#f2f5f9" : "#15202b");

const circle = (colour, around) =>
  drawnSmall(96, 96, (context) => {
    context.arc(48, 48, 38, 0, 2 * Math.PI);
    for (const [strokeStyle, lineWidth] of [[around, 16], [colour, 9]])
      Object.assign(context, { strokeStyle, lineWidth }).stroke();
  });

export class Labels {
  constructor(scene, model, group) {
    const letters = scene.letters.map((item) => ({ ...item, link: model.links.indexOf(item.link), sprite: sprite(10) }));
    Object.assign(this, { model, letters, shown: true, dark: false, name: null, ring: sprite(11), label: sprite(12) });
    for (const { sprite } of letters) sprite.center.set(-0.12, -0.12);
    this.label.center.set(-0.25, -0.3);
    group.add(...letters.map(({ sprite }) => sprite), this.ring, this.label);
  }

  paint(dark) {
    Object.assign(this, { dark, name: null });
    for (const { name, sprite } of this.letters) paint(sprite, written(letterOf(name), INK(dark), halo(dark)));
    paint(this.ring, circle(RED(dark), halo(dark)));
  }

  /** @param {number[]} values @param {import("../solver/motion.js").Reason|null} reason */
  place(values, reason) {
    const { frames } = configurationAt(this.model, values);
    this.letters.forEach(({ sprite, link, at }, k) =>
      sprite.position.set(...placed(frames[link], this.model.letters?.[k] ?? at)),
    );
    const joint = blamed(this.model, reason);
    this.ring.visible = this.label.visible = Boolean(joint);
    if (!joint) return;
    for (const own of [this.ring, this.label]) own.position.set(...placed(frames[joint.parent], joint.at));
    if (this.name === reason.joint) return;
    this.name = reason.joint;
    paint(this.label, written(/^(.*?)(\d*)$/.exec(this.name).slice(1), RED(this.dark), halo(this.dark)));
  }

  /** For a picture of so many pixels, in the group's own scale: a letter gives way to those before it, and to the ring. */
  arrange(camera, width, height, scale) {
    const sized = (sprite, pixels) => {
      resize(sprite, pixels, camera, height, scale);
      return onScreen(sprite, camera, width, height);
    };
    const taken = this.ring.visible ? [sized(this.ring, 34)] : [];
    if (this.ring.visible) sized(this.label, 29);
    for (const { sprite } of this.letters) {
      const [x, y] = sized(sprite, 27);
      const free = !taken.some(([a, b]) => Math.abs(a - x) < 20 && Math.abs(b - y) < 14);
      sprite.visible = this.shown && free;
      if (free) taken.push([x, y]);
    }
  }
}
