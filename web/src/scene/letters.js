/** Letters of points and joints: sprites of one size on the screen, set beside their point, none over another. */

import { CanvasTexture, LinearFilter, Sprite, SpriteMaterial, SRGBColorSpace, Vector3 } from "three";
import { letterOf } from "../dom.js";
import { configurationAt } from "../solver/configuration.js";
import { placed } from "../solver/rotation.js";

const HEIGHT = 64;
const PIXELS = 27;

/** A letter with its index on a canvas, in a colour, with a halo that keeps it apart from what is behind it. */
export function written([letter, index], colour, halo) {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d");
  const big = `italic 600 ${0.66 * HEIGHT}px Georgia, "Times New Roman", serif`;
  const small = `600 ${0.44 * HEIGHT}px Georgia, "Times New Roman", serif`;
  context.font = big;
  const first = context.measureText(letter).width;
  context.font = small;
  canvas.width = Math.ceil(first + context.measureText(index).width + 22);
  canvas.height = HEIGHT;
  context.lineJoin = "round";
  context.lineWidth = 9;
  context.strokeStyle = halo;
  context.fillStyle = colour;
  for (const draw of ["strokeText", "fillText"]) {
    context.font = big;
    context[draw](letter, 9, 0.66 * HEIGHT);
    context.font = small;
    context[draw](index, 11 + first, 0.82 * HEIGHT);
  }
  return canvas;
}

/** What is behind letters, on a light and on a dark page. */
export const halo = (dark) => (dark ? "rgba(16,20,26,.85)" : "rgba(255,255,255,.9)");

/** A texture of a canvas, for sprites. */
export function textureOf(canvas) {
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.minFilter = LinearFilter;
  texture.generateMipmaps = false;
  return texture;
}

/** A sprite of one size on the screen, over everything; nothing can be picked by it. */
export function sprite(order) {
  const look = { depthTest: false, depthWrite: false, sizeAttenuation: false, toneMapped: false };
  const found = new Sprite(new SpriteMaterial(look));
  found.renderOrder = order;
  found.raycast = () => {};
  return found;
}

/** The height of a sprite of so many pixels, in the group's own scale. */
export const spriteSize = (pixels, camera, height, scale) =>
  (2 * pixels * Math.tan((camera.fov * Math.PI) / 360)) / height / scale;

/** Where on the screen a sprite stands, in pixels. @returns {[number, number]} */
export function onScreen(object, camera, width, height) {
  const at = object.getWorldPosition(new Vector3()).project(camera);
  return [((at.x + 1) / 2) * width, ((1 - at.y) / 2) * height];
}

/** Letters that stand at their points, and `arrange`, which hides those that would lie over another. */
export class Letters {
  constructor(scene, model, group) {
    this.model = model;
    this.items = scene.letters.map(({ name, link, at }) => ({
      name,
      at,
      link: model.links.indexOf(link),
      sprite: sprite(10),
    }));
    this.shown = true;
    for (const { sprite } of this.items) {
      sprite.center.set(-0.12, -0.12);
      group.add(sprite);
    }
  }

  paint(dark) {
    for (const item of this.items) {
      item.sprite.material.map?.dispose();
      const canvas = written(letterOf(item.name), dark ? "#f2f5f9" : "#15202b", halo(dark));
      item.sprite.material.map = textureOf(canvas);
      item.sprite.material.needsUpdate = true;
      item.shape = canvas.width / canvas.height;
    }
  }

  place(values) {
    const { frames } = configurationAt(this.model, values);
    for (const { sprite, link, at } of this.items) sprite.position.set(...placed(frames[link], at));
  }

  /**
   * For a picture of so many pixels, in the group's own scale.
   * @param {number[][]} taken places on the screen that are left free
   */
  arrange(camera, width, height, scale, taken) {
    const size = spriteSize(PIXELS, camera, height, scale);
    for (const { sprite, shape } of this.items) {
      sprite.scale.set(size * shape, size, 1);
      const [x, y] = onScreen(sprite, camera, width, height);
      const free = !taken.some(([a, b]) => Math.abs(a - x) < 20 && Math.abs(b - y) < 14);
      sprite.visible = this.shown && free;
      if (free) taken.push([x, y]);
    }
  }
}
