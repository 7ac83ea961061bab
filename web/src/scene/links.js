/** The mechanism's links: one mesh each, placed by the link's frame. Ghosts share the same geometry. */

import { Group, Mesh, MeshBasicMaterial, MeshLambertMaterial, MeshStandardMaterial } from "three";
import { configurationAt } from "../solver/configuration.js";
import { joined } from "./shapes.js";

/** Geometry of every link that has parts. @returns {Map<number, import("three").BufferGeometry>} */
export function linkGeometries(scene, model) {
  const found = new Map();
  model.links.forEach((name, k) => {
    const parts = scene.parts.filter((part) => part.link === name);
    if (parts.length) found.set(k, joined(parts));
  });
  return found;
}

/** Plain and lit; its own colour dims all parts, as a dark page wants it. */
const steel = () => new MeshStandardMaterial({ vertexColors: true, roughness: 0.45, metalness: 0 });

/** Translucent in one colour; only the side next to the reader is seen, because its depth is drawn first. What lies in
 * one place is drawn one behind the other: the mechanism itself, then its ghosts in their order. */
function ghostMaterials(colour, order) {
  const behind = { polygonOffset: true, polygonOffsetFactor: order, polygonOffsetUnits: 4 * order };
  const depth = new MeshBasicMaterial({ colorWrite: false, ...behind });
  const look = { color: colour, transparent: true, opacity: 0.3, depthWrite: false };
  return { depth, tint: new MeshLambertMaterial({ ...look, ...behind }) };
}

/** A body of meshes, one for each link; a ghost in one colour, so many places behind.
 * @returns {{group: Group, place: (values: number[]) => void, tint: object}} tint: its material */
export function body(model, geometries, { ghost = null, behind = 1 } = {}) {
  const group = new Group();
  const meshes = new Map();
  const { depth, tint } = ghost ? ghostMaterials(ghost, behind) : { tint: steel() };
  for (const [link, geometry] of geometries) {
    if (ghost && link === 0) continue;
    const mesh = new Mesh(geometry, tint);
    mesh.matrixAutoUpdate = false;
    mesh.castShadow = mesh.receiveShadow = !ghost;
    Object.assign(mesh.userData, { link: model.links[link], still: link === 0 });
    if (ghost) {
      mesh.renderOrder = 2;
      const first = new Mesh(geometry, depth);
      first.renderOrder = 1;
      first.raycast = () => {};
      mesh.add(first);
    }
    group.add(mesh);
    meshes.set(link, mesh);
  }
  const place = (values) => {
    const { frames } = configurationAt(model, values);
    for (const [link, mesh] of meshes) setFrame(mesh, frames[link]);
  };
  return { group, place, tint };
}

/** Puts an object where a frame is. */
function setFrame(object, { turn: r, origin: o }) {
  object.matrix.set(r[0], r[1], r[2], o[0], r[3], r[4], r[5], o[1], r[6], r[7], r[8], o[2], 0, 0, 0, 1);
  object.matrixWorldNeedsUpdate = true;
}
