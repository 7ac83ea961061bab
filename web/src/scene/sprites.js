/** Pictures on canvases, and sprites of one size on the screen that show them over everything. */

import { CanvasTexture, LinearFilter, Sprite, SpriteMaterial, SRGBColorSpace, Vector3 } from "three";

const HEIGHT = 64;

/** What a call draws on a canvas of so many pixels, as a texture with properties of its own. */
export function drawn(width, height, draw, look) {
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  draw(canvas.getContext("2d"));
  return Object.assign(new CanvasTexture(canvas), { colorSpace: SRGBColorSpace, ...look });
}

/** The same for sprites, which are as small on the screen as they are drawn. */
export const drawnSmall = (...given) => drawn(...given, { minFilter: LinearFilter, generateMipmaps: false });

/** A letter with its index, in a colour, with a halo that keeps it apart from what is behind it. */
export const written = ([letter, index], colour, halo) =>
  drawnSmall(1, HEIGHT, (context) => {
    const big = `italic 600 ${0.66 * HEIGHT}px Georgia, "Times New Roman", serif`;
    const small = `600 ${0.44 * HEIGHT}px Georgia, "Times New Roman", serif`;
    const width = (font, text) => Object.assign(context, { font }).measureText(text).width;
    const first = width(big, letter);
    context.canvas.width = Math.ceil(first + width(small, index) + 22);
    Object.assign(context, { lineJoin: "round", lineWidth: 9, strokeStyle: halo, fillStyle: colour });
    for (const draw of ["strokeText", "fillText"]) {
      context.font = big;
      context[draw](letter, 9, 0.66 * HEIGHT);
      context.font = small;
      context[draw](index, 11 + first, 0.82 * HEIGHT);
    }
  });

/** What is behind letters, on a light and on a dark page. */
export const halo = (dark) => (dark ? "rgba(16,20,26,.85)" : "rgba(255,255,255,.9)");

export function sprite(order) {
  const look = { depthTest: false, depthWrite: false, sizeAttenuation: false, toneMapped: false };
  return Object.assign(new Sprite(new SpriteMaterial(look)), { renderOrder: order });
}

/** Gives a sprite another picture. */
export function paint({ material }, picture) {
  material.map?.dispose();
  material.map = picture;
  material.needsUpdate = true;
}

/** Makes a sprite so many pixels high in a picture of a height, in a group of a scale. */
export function resize(sprite, pixels, camera, height, scale) {
  const size = (2 * pixels * Math.tan((camera.fov * Math.PI) / 360)) / height / scale;
  const { image } = sprite.material.map;
  sprite.scale.set((size * image.width) / image.height, size, 1);
}

/** Where on the screen a sprite stands, in pixels. @returns {[number, number]} */
export function onScreen(object, camera, width, height) {
  const at = object.getWorldPosition(new Vector3()).project(camera);
  return [((at.x + 1) / 2) * width, ((1 - at.y) / 2) * height];
}
