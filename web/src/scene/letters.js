/** Letters of points and joints, set beside their point, none over another. */

import { letterOf } from "../dom.js";
import { configurationAt } from "../solver/configuration.js";
import { placed } from "../solver/rotation.js";
import { halo, onScreen, paint, resize, sprite, written } from "./sprites.js";

const PIXELS = 27;

export class Letters {
  constructor(scene, model, group) {
    Object.assign(this, { model, shown: true });
    this.items = scene.letters.map((item) => ({ ...item, link: model.links.indexOf(item.link), sprite: sprite(10) }));
    for (const { sprite } of this.items) {
      sprite.center.set(-0.12, -0.12);
      group.add(sprite);
    }
  }

  paint(dark) {
    for (const { name, sprite } of this.items)
      paint(sprite, written(letterOf(name), dark ? "#f2f5f9" : "#15202b", halo(dark)));
  }

  place(values) {
    const { frames } = configurationAt(this.model, values);
    for (const { sprite, link, at } of this.items) sprite.position.set(...placed(frames[link], at));
  }

  /** For a picture of so many pixels, in the group's own scale; places on the screen that are taken are left free. */
  arrange(camera, width, height, scale, taken) {
    for (const { sprite } of this.items) {
      resize(sprite, PIXELS, camera, height, scale);
      const [x, y] = onScreen(sprite, camera, width, height);
      const free = !taken.some(([a, b]) => Math.abs(a - x) < 20 && Math.abs(b - y) < 14);
      sprite.visible = this.shown && free;
      if (free) taken.push([x, y]);
    }
  }
}
