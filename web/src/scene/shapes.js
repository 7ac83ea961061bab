/** Solids of the scene as triangles with flat faces, smooth rounds and small bevels that catch the light. */

import { BufferAttribute, Color, ExtrudeGeometry, Matrix4, Shape, SphereGeometry, Vector3 } from "three";
import { mergeGeometries, toCreasedNormals } from "three/addons/utils/BufferGeometryUtils.js";

const CREASE = 0.5;
const BEVEL = 0.14;
const ROUND = 14;

const vector = (numbers) => new Vector3(...numbers);

/** A plane outline extruded both ways from its plane, its edges bevelled. */
function prism(outline, thickness, thinnest) {
  const bevel = Math.min(BEVEL * thinnest, 0.3 * thickness);
  const edges = { bevelThickness: bevel, bevelSize: bevel, bevelOffset: -bevel, bevelSegments: 1 };
  const geometry = new ExtrudeGeometry(outline, { depth: thickness - 2 * bevel, curveSegments: ROUND, ...edges });
  geometry.translate(0, 0, bevel - thickness / 2);
  return toCreasedNormals(geometry, CREASE);
}

/** Puts a solid made about the origin where its own axes x, y, z and its origin are. */
function placed(geometry, x, y, z, origin) {
  return geometry.applyMatrix4(new Matrix4().makeBasis(x, y, z).setPosition(origin));
}

/** Two unit vectors across a direction. */
function across(z) {
  const helper = Math.abs(z.z) < 0.9 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0);
  const x = new Vector3().crossVectors(helper, z).normalize();
  return [x, new Vector3().crossVectors(z, x)];
}

function ball({ centre, radius }) {
  return new SphereGeometry(radius, 36, 24).toNonIndexed().translate(...centre);
}

/** A solid from one point to another: of the unit vector, the length and the point between; a ball where they are one. */
function along({ start, end, radius }, make) {
  const [a, b] = [vector(start), vector(end)];
  const way = b.clone().sub(a);
  const length = way.length();
  return length > 1e-9 * radius ? make(way.divideScalar(length), length, a.lerp(b, 0.5)) : ball({ centre: start, radius });
}

const cylinder = (shape) =>
  along(shape, (z, length, middle) => {
    const outline = new Shape().absarc(0, 0, shape.radius, 0, 2 * Math.PI);
    return placed(prism(outline, length, shape.radius), ...across(z), z, middle);
  });

function box({ centre, sides }) {
  const ways = sides.map(vector);
  const half = ways.map((way) => way.length());
  const order = [0, 1, 2].sort((i, j) => half[j] - half[i]); // the thinnest side is extruded
  const [x, y, z] = order.map((k) => ways[k].clone().divideScalar(half[k]));
  if (new Vector3().crossVectors(x, y).dot(z) < 0) z.negate();
  const [a, b, c] = order.map((k) => half[k]);
  const outline = rounded([[-a, -b], [a, -b], [a, b], [-a, b]], 0.35 * Math.min(b, c));
  return placed(prism(outline, 2 * c, c), x, y, z, vector(centre));
}

const bar = (shape) =>
  along(shape, (x, length, middle) => {
    const { normal, radius, thickness } = shape;
    const [z, quarter] = [vector(normal), Math.PI / 2];
    const outline = new Shape().absarc(length / 2, 0, radius, -quarter, quarter);
    outline.absarc(-length / 2, 0, radius, quarter, 3 * quarter);
    return placed(prism(outline, thickness, thickness), x, new Vector3().crossVectors(z, x), z, middle);
  });

function slab({ outline, along }) {
  const corners = outline.map(vector);
  const z = vector(along);
  const thickness = z.length();
  z.divideScalar(thickness);
  const [x, y] = across(z);
  const flat = rounded(corners.map((corner) => [corner.dot(x), corner.dot(y)]), 1.2 * thickness);
  return placed(prism(flat, thickness, thickness), x, y, z, z.clone().multiplyScalar(corners[0].dot(z) + thickness / 2));
}

/** A convex polygon with rounded corners. */
function rounded(corners, radius) {
  const shape = new Shape();
  corners.forEach((corner, k) => {
    const before = corners[(k + corners.length - 1) % corners.length];
    const after = corners[(k + 1) % corners.length];
    const [inX, inY] = towards(corner, before, radius);
    const [outX, outY] = towards(corner, after, radius);
    k === 0 ? shape.moveTo(inX, inY) : shape.lineTo(inX, inY);
    shape.quadraticCurveTo(...corner, outX, outY);
  });
  shape.closePath();
  return shape;
}

function towards(from, to, distance) {
  const way = [to[0] - from[0], to[1] - from[1]];
  const share = Math.min(0.5, distance / Math.hypot(...way));
  return [from[0] + share * way[0], from[1] + share * way[1]];
}

const SOLIDS = { ball, cylinder, box, bar, slab };

/** @returns {import("three").BufferGeometry} positions, normals and one colour of a part, in its link's frame */
function solid({ shape, colour }) {
  const geometry = SOLIDS[shape.kind](shape);
  geometry.deleteAttribute("uv");
  const { r, g, b } = new Color(colour);
  const count = geometry.getAttribute("position").count;
  const colours = new Float32Array(3 * count);
  for (let k = 0; k < count; k++) colours.set([r, g, b], 3 * k);
  geometry.setAttribute("color", new BufferAttribute(colours, 3));
  return geometry;
}

/** All parts of one link as one geometry. */
export const joined = (parts) => mergeGeometries(parts.map(solid));
