/** Layers in the base frame: workspace, singular surfaces, sections' outlines, and forces over all, unpacked from small integers. */

import * as THREE from "three";

const STEPS = 65535;

/** Of a base64 text. */
const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;

/** Positions of a layer: 0 to 65535 runs from low to high. @returns {Float32Array} */
function positions({ vertices, low, high }) {
  return Float32Array.from(
    new Uint16Array(bytes(vertices)),
    (value, k) => low[k % 3] + (value / STEPS) * (high[k % 3] - low[k % 3]),
  );
}

/** @returns {import("three").Object3D} a layer: a translucent surface, or lines */
export function layerOf(layer) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions(layer), 3));
  const faces = bytes(layer.faces);
  geometry.setIndex(new THREE.BufferAttribute(layer.wide ? new Uint32Array(faces) : new Uint16Array(faces), 1));
  const { colour: color, opacity, kind } = layer;
  if (layer.primitive === "segments") return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color }));
  geometry.computeVertexNormals();
  const look = { color, transparent: true, opacity, side: THREE.DoubleSide, depthWrite: false, depthTest: kind !== "force" };
  return Object.assign(new THREE.Mesh(geometry, new THREE.MeshLambertMaterial(look)), { renderOrder: 4 });
}
