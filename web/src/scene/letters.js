/** Letters of points and joints: sprites of one size on the screen, set beside their point, none over another. */

import { CanvasTexture, LinearFilter, Sprite, SpriteMaterial, SRGBColorSpace, Vector3 } from "three";
import { letterOf } from "../dom.js";
import { frames } from "../solver/frames.js";
import { add, apply } from "../solver/rotation.js";

const HEIGHT = 64;
const PIXELS = 27;

function picture(name, dark) {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d");
  const [letter, index] = letterOf(name);
  const big = `italic 600 ${0.66 * HEIGHT}px Georgia, "Times New Roman", serif`;
  const small = `600 ${0.44 * HEIGHT}px Georgia, "Times New Roman", serif`;
  context.font = big;
  const first = context.measureText(letter).width;
  context.font = small;
  canvas.width = Math.ceil(first + context.measureText(index).width + 22);
  canvas.height = HEIGHT;
  context.lineJoin = "round";
  context.lineWidth = 9;
  context.strokeStyle = dark ? "rgba(16,20,26,.85)" : "rgba(255,255,255,.9)";
  context.fillStyle = dark ? "#f2f5f9" : "#15202b";
  for (const draw of ["strokeText", "fillText"]) {
    context.font = big;
    context[draw](letter, 9, 0.66 * HEIGHT);
    context.font = small;
    context[draw](index, 11 + first, 0.82 * HEIGHT);
  }
  return canvas;
}

/** Letters that stand at their points, and `arrange`, which hides those that would lie over another. */
export class Letters {
  constructor(scene, model, group) {
    this.model = model;
    this.items = scene.letters.map(({ name, link, at }) => ({
      name,
      at,
      link: model.links.indexOf(link),
      sprite: new Sprite(
        new SpriteMaterial({ depthTest: false, depthWrite: false, sizeAttenuation: false, toneMapped: false }),
      ),
    }));
    this.shown = true;
    for (const { sprite } of this.items) {
      sprite.renderOrder = 10;
      sprite.center.set(-0.12, -0.12);
      sprite.raycast = () => {};
      group.add(sprite);
    }
  }

  paint(dark) {
    for (const item of this.items) {
      item.sprite.material.map?.dispose();
      const canvas = picture(item.name, dark);
      const texture = new CanvasTexture(canvas);
      texture.colorSpace = SRGBColorSpace;
      texture.minFilter = LinearFilter;
      texture.generateMipmaps = false;
      item.sprite.material.map = texture;
      item.sprite.material.needsUpdate = true;
      item.shape = canvas.width / canvas.height;
    }
  }

  place(values) {
    const placed = frames(this.model, values);
    for (const { sprite, link, at } of this.items)
      sprite.position.set(...add(placed[link].origin, apply(placed[link].turn, at)));
  }

  /** For a picture of so many pixels, in the group's own scale. */
  arrange(camera, width, height, scale) {
    const size = (2 * PIXELS * Math.tan((camera.fov * Math.PI) / 360)) / height / scale;
    const taken = [];
    const at = new Vector3();
    for (const { sprite, shape } of this.items) {
      sprite.scale.set(size * shape, size, 1);
      sprite.getWorldPosition(at).project(camera);
      const [x, y] = [((at.x + 1) / 2) * width, ((1 - at.y) / 2) * height];
      const free = !taken.some(([a, b]) => Math.abs(a - x) < 20 && Math.abs(b - y) < 14);
      sprite.visible = this.shown && free;
      if (free) taken.push([x, y]);
    }
  }
}
