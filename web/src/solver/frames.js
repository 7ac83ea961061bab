/** Frames of the links along the spanning tree, and the unit twists of the joint values. */

import {
  IDENTITY,
  aboutAxis,
  add,
  apply,
  cross,
  fromVector,
  leftJacobian,
  multiply,
  subtract,
  times,
  transpose,
} from "./rotation.js";

/**
 * @typedef {{turn: number[], origin: number[]}} Frame orientation and origin in the base frame
 * @typedef {{name: string, type: string, parent: number, child: number, at: number[], childAt: number[],
 *   axes: number[][], turn: number[], pitch: number, first: number, freedoms: number, limits: (number[]|null)[],
 *   cone: number|null, coneAxis: number[]|null}} Joint
 * @typedef {{joints: Joint[], links: string[], base: number, tree: {joint: number, forward: boolean}[], cut: number[],
 *   loops: Map<number, number>[], pathToPlatform: Map<number, number>, platform: number, point: number[],
 *   pose: string[], count: number, length: number, scale: number[], units: number[],
 *   coordinates: {label: string, kind: string, counted: boolean, size: number}[],
 *   inputs: {name: string, index: number, sign: number, offset: number, kind: string, counted: boolean,
 *   stroke: number[]|null, range: number[]}[], unit: string, home: number[]}} Model
 */

/** The scene's joint graph, its links as numbers. @returns {Model} */
export function modelOf(scene) {
  const { graph, platform } = scene;
  const place = new Map(graph.links.map((name, k) => [name, k]));
  const joints = graph.joints.map((joint) => ({
    ...joint,
    parent: place.get(joint.parent),
    child: place.get(joint.child),
    turn: joint.turn.flat(),
  }));
  const paths = [];
  paths[place.get(graph.base)] = new Map();
  for (const { joint, forward } of graph.tree) {
    const { parent, child } = joints[joint];
    paths[forward ? child : parent] = new Map(paths[forward ? parent : child]).set(joint, forward ? 1 : -1);
  }
  return {
    joints,
    links: graph.links,
    base: place.get(graph.base),
    tree: graph.tree,
    cut: graph.cut,
    loops: graph.cut.map((k) => difference(paths[joints[k].parent], paths[joints[k].child]).set(k, 1)),
    pathToPlatform: paths[place.get(platform.link)],
    platform: place.get(platform.link),
    point: platform.point,
    pose: platform.pose,
    count: scene.home.length,
    length: scene.characteristicLength,
    scale: scene.coordinates.map((item) => (item.kind === "length" ? scene.characteristicLength : 1)),
    units: scene.coordinates.map((item) => item.size ?? (item.kind === "length" ? scene.characteristicLength : 1)),
    coordinates: scene.coordinates,
    inputs: scene.inputs,
    unit: scene.unit,
    home: scene.home,
  };
}

function difference(first, second) {
  const found = new Map(first);
  for (const [joint, sense] of second) found.has(joint) ? found.delete(joint) : found.set(joint, -sense);
  return found;
}

/** How a joint has moved its child's joint frame in its parent's. */
function motion(joint, values) {
  const v = values[joint.first];
  const axis = joint.axes[0];
  switch (joint.type) {
    case "S":
      return [fromVector([v, values[joint.first + 1], values[joint.first + 2]]), null];
    case "P":
      return [null, times(v, axis)];
    case "R":
      return [aboutAxis(axis, v), null];
    case "H":
      return [aboutAxis(axis, v), times((v * joint.pitch) / (2 * Math.PI), axis)];
    case "C":
      return [aboutAxis(axis, values[joint.first + 1]), times(v, axis)];
    case "U":
      return [multiply(aboutAxis(axis, v), aboutAxis(joint.axes[1], values[joint.first + 1])), null];
    default:
      throw new Error(`joint ${joint.name}: no motion for the type ${joint.type}`);
  }
}

/** @param {Joint} joint @param {Frame} parent @param {number[]} values @returns {Frame} */
export function childFrame(joint, parent, values) {
  const [turned, shift] = motion(joint, values);
  const turn = multiply(turned ? multiply(parent.turn, turned) : parent.turn, joint.turn);
  const origin = add(parent.origin, apply(parent.turn, shift ? add(joint.at, shift) : joint.at));
  return { turn, origin: subtract(origin, apply(turn, joint.childAt)) };
}

function parentFrame(joint, child, values) {
  const [turned, shift] = motion(joint, values);
  const back = multiply(child.turn, transpose(joint.turn));
  const turn = turned ? multiply(back, transpose(turned)) : back;
  const origin = add(child.origin, apply(child.turn, joint.childAt));
  return { turn, origin: subtract(origin, apply(turn, shift ? add(joint.at, shift) : joint.at)) };
}

/** Frames of all links; loops need not close. @param {Model} model @param {number[]} values @returns {Frame[]} */
export function frames(model, values) {
  const placed = [];
  placed[model.base] = { turn: IDENTITY, origin: [0, 0, 0] };
  for (const { joint: k, forward } of model.tree) {
    const joint = model.joints[k];
    if (forward) placed[joint.child] = childFrame(joint, placed[joint.parent], values);
    else placed[joint.parent] = parentFrame(joint, placed[joint.child], values);
  }
  return placed;
}

/** Axes in the parent's frame with their pitches in length per rad (Infinity: a shift). */
function localAxes(joint, values) {
  const axis = joint.axes[0];
  switch (joint.type) {
    case "S": {
      const j = leftJacobian(values.slice(joint.first, joint.first + 3));
      return [0, 1, 2].map((k) => [[j[k], j[k + 3], j[k + 6]], 0]);
    }
    case "U":
      return [
        [axis, 0],
        [apply(aboutAxis(axis, values[joint.first]), joint.axes[1]), 0],
      ];
    case "C":
      return [
        [axis, Infinity],
        [axis, 0],
      ];
    case "P":
      return [[axis, Infinity]];
    case "H":
      return [[axis, joint.pitch / (2 * Math.PI)]];
    default:
      return [[axis, 0]];
  }
}

/**
 * Unit twists of the joint values: angular velocity, and velocity of the body point at the base's origin.
 * @param {Model} model @param {Frame[]} placed @param {number[]} values
 * @returns {{angular: number[], linear: number[]}[]} one for each joint value
 */
export function screws(model, placed, values) {
  const twists = new Array(model.count);
  for (const joint of model.joints) {
    const { turn, origin } = placed[joint.parent];
    const point = add(origin, apply(turn, joint.at));
    localAxes(joint, values).forEach(([local, pitch], k) => {
      const axis = apply(turn, local);
      twists[joint.first + k] =
        pitch === Infinity
          ? { angular: [0, 0, 0], linear: axis }
          : { angular: axis, linear: add(times(pitch, axis), cross(point, axis)) };
    });
  }
  return twists;
}
