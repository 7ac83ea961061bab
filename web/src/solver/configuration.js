/**
 * The joint graph at joint values: frames of its links, gaps of its loops, twists.
 *
 * They are worked out by a program that Python has written from the one joint graph (`assur.page.configuration`). What
 * is left here is where the steps stand that joints are made of: lengths, cosines and sines, quaternions.
 */

import { leftJacobian, quaternionOf } from "./rotation.js";

/**
 * @typedef {ArrayLike<number>} Numbers
 * @typedef {{turn: Numbers, origin: Numbers}} Frame orientation, nine numbers row by row, and origin in the base frame
 * @typedef {{name: string, parent: number, child: number, at: number[], childAt: number[], first: number,
 *   freedoms: number, limits: (number[]|null)[], cone: number|null, coneAxis: number[]|null}} Joint
 * @typedef {{program: (state: number[], dimensions: number[], numbers: Float64Array) => void, dimensions: number[],
 *   joints: Joint[], links: string[], steps: {kind: string, first: number}[], balls: number[], cut: number[],
 *   point: number[], pose: string[], count: number, length: number, scale: number[], units: number[],
 *   coordinates: {label: string, kind: string, counted: boolean, size: number}[],
 *   inputs: {name: string, index: number, sign: number, offset: number, kind: string, counted: boolean,
 *   stroke: number[]|null, range: number[]}[], unit: string, home: number[]}} Model balls: first joint value of each
 */

/** The numbers that say where a step stands. */
const STATE = {
  turn: (value) => [Math.cos(value), Math.sin(value)],
  slide: (value) => [value],
  screw: (value) => [Math.cos(value), Math.sin(value), value],
  ball: (...vector) => quaternionOf(vector),
};

/** The scene's joint graph, its links as numbers. @returns {Model} */
export function modelOf(scene) {
  const { graph, coordinates, characteristicLength: length } = scene;
  const place = new Map(graph.links.map((name, k) => [name, k]));
  const ends = ({ parent, child }) => ({ parent: place.get(parent), child: place.get(child) });
  const scale = coordinates.map((item) => (item.kind === "length" ? length : 1));
  return {
    program: scene.configuration,
    dimensions: graph.dimensions,
    joints: graph.joints.map((joint) => ({ ...joint, ...ends(joint) })),
    links: graph.links,
    steps: graph.steps,
    balls: graph.steps.filter(({ kind }) => kind === "ball").map(({ first }) => first),
    cut: graph.cut,
    pose: scene.platform.pose,
    count: scene.home.length,
    length,
    scale,
    units: coordinates.map((item, k) => item.size ?? scale[k]),
    coordinates,
    inputs: scene.inputs,
    unit: scene.unit,
    home: scene.home,
  };
}

/** What the program is given at joint values: where each step stands, then what the rates of ball joints mean. */
function stateOf(model, values) {
  const state = model.steps.flatMap(({ kind, first }) => STATE[kind](...values.slice(first, kind === "ball" ? first + 3 : first + 1)));
  for (const first of model.balls) state.push(...leftJacobian(values.slice(first, first + 3)));
  return state;
}

/**
 * Everything that is asked of joint values; loops need not close.
 * @param {Model} model @param {number[]} values
 * @returns {{gaps: {distance: Numbers, turn: Numbers}[], derivative: Float64Array[], platform: Frame,
 *   moves: Float64Array[], frames: Frame[]}} of each cut joint how far it is from closing its loop, and six rows of rates
 * of that for each joint value, velocities first; the platform at its point, and six rows of its rates, angular
 * velocities first; frames of all links
 */
export function configurationAt(model, values) {
  const [loops, count, links] = [model.cut.length, model.count, model.links.length];
  const numbers = new Float64Array(12 * (loops + 1 + links) + 6 * count * (loops + 1));
  model.program(stateOf(model, values), model.dimensions, numbers);
  let start = 0;
  const next = (size) => numbers.subarray(start, (start += size));
  const list = (length, make) => Array.from({ length }, make);
  const frame = () => ({ turn: next(9), origin: next(3) });
  return {
    gaps: list(loops, () => ({ distance: next(3), turn: next(9) })),
    derivative: list(6 * loops, () => next(count)),
    platform: frame(),
    moves: list(6, () => next(count)),
    frames: list(links, frame),
  };
}
