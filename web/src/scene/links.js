/** The mechanism's links: one mesh each, placed by the link's frame. Ghosts share the same geometry. */

import { Group, Mesh, MeshBasicMaterial, MeshLambertMaterial, MeshStandardMaterial } from "three";
import { configurationAt } from "../solver/configuration.js";
import { joined } from "./shapes.js";

/** Solids of the file's dimensions by their link; with others, bars between the middle and the joints of each. */
export class LinkGeometries extends Map {
  constructor(scene, model) {
    super();
    model.links.forEach((name, k) => {
      const parts = scene.parts.filter((part) => part.link === name);
      if (parts.length) this.set(k, joined(parts));
    });
    this.solids = new Map(this);
    Object.assign(this, { scene, model, sizes: model.sizes });
  }

  /** Follows the model to its dimensions. */
  resize(resized) {
    const { model, sizes, scene } = this;
    if (sizes === model.sizes) return;
    this.sizes = model.sizes;
    for (const [link, solid] of this.solids) {
      if (this.get(link) !== solid) this.get(link).dispose();
      this.set(link, resized ? joined(bars(scene, model, link)) : solid);
    }
  }
}

function bars({ parts, extent }, { joints, links }, link) {
  const { colour } = parts.find((part) => part.link === links[link]);
  const ends = joints.flatMap(({ parent, child, at, childAt }) => [
    ...(parent === link ? [at] : []),
    ...(child === link ? [childAt] : []),
  ]);
  const middle = [0, 1, 2].map((k) => ends.reduce((sum, end) => sum + end[k], 0) / ends.length);
  const radius = 0.009 * extent;
  const balls = ends.map((centre) => ({ kind: "ball", centre, radius: 1.4 * radius }));
  const ways = link === 0 ? [] : ends.map((end) => ({ kind: "cylinder", start: middle, end, radius }));
  return [...balls, ...ways].map((shape) => ({ shape, colour }));
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
    for (const [link, mesh] of meshes) {
      for (const each of [mesh, ...mesh.children]) each.geometry = geometries.get(link);
      setFrame(mesh, frames[link]);
    }
  };
  return { group, place, tint };
}

/** Puts an object where a frame is. */
function setFrame(object, { turn: r, origin: o }) {
  object.matrix.set(r[0], r[1], r[2], o[0], r[3], r[4], r[5], o[1], r[6], r[7], r[8], o[2], 0, 0, 0, 1);
  object.matrixWorldNeedsUpdate = true;
}
