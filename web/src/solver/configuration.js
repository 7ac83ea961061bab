/**
 * The joint graph at joint values: frames of its links, gaps of its loops, twists.
 *
 * They are worked out by a program that Python has written from the one joint graph (`assur.page.configuration`). What
 * is left here is where the steps stand that joints are made of: lengths, cosines and sines, quaternions.
 */

import { leftJacobian, norm, quaternionOf } from "./rotation.js";

/** @typedef {{turn: ArrayLike<number>, origin: ArrayLike<number>}} Frame nine numbers row by row, and three, in the base frame */

/** The numbers that say where a step stands, from the values of its coordinates. */
const STATE = {
  turn: ([value]) => [Math.cos(value), Math.sin(value)],
  slide: ([value]) => [value],
  screw: ([value]) => [Math.cos(value), Math.sin(value), value],
  ball: quaternionOf,
};

/** What of a scene is computed with: its joint graph, links as numbers; `balls`: the first joint value of each. */
export function modelOf(scene) {
  const { graph, coordinates, inputs, unit, home, sizes = [], characteristicLength: length } = scene;
  const place = (name) => graph.links.indexOf(name);
  const balls = graph.steps.filter(({ kind }) => kind === "ball");
  return {
    ...graph,
    program: scene.configuration,
    resize: scene.resize,
    sizes: sizes.map(({ value }) => value),
    kernel: scene.kernelParameters,
    joints: graph.joints.map((joint) => ({ ...joint, parent: place(joint.parent), child: place(joint.child) })),
    balls: balls.map(({ first }) => first),
    coordinates,
    inputs,
    pose: scene.platform.pose,
    home,
    count: home.length,
    unit,
    length,
    own: length,
    ...scales(coordinates, length, length),
  };
}

/** What a change of one is of each joint value, screws as they advance (`units`) or as they turn. */
const scales = (coordinates, length, own) => ({
  scale: coordinates.map(({ kind }) => (kind === "length" ? length : 1)),
  units: coordinates.map(({ kind, size }) => (kind !== "length" && size === 1 ? 1 : (size * length) / own)),
});

/** Takes other dimensions, those of the sliders in lengths and rad: all that depends on them follows. */
export function resize(model, sizes) {
  const { at, childAt, ...found } = model.resize(sizes);
  const length = Math.max(...at.map(norm), ...childAt.map(norm)) || 1;
  model.joints.forEach((joint, k) => Object.assign(joint, { at: at[k], childAt: childAt[k] }));
  Object.assign(model, { ...found, sizes, length, ...scales(model.coordinates, length, model.own) });
}

/** @typedef {ReturnType<typeof modelOf>} Model */

/** What the program is given at joint values: where each step stands, then what the rates of ball joints mean. */
function stateOf(model, values) {
  const state = [];
  for (const { kind, first } of model.steps) state.push(...STATE[kind](values.slice(first, first + 3)));
  for (const first of model.balls) state.push(...leftJacobian(values.slice(first, first + 3)));
  return state;
}

/**
 * Everything that is asked of joint values; loops need not close. The program writes it row by row into one list, in the
 * order of `assur.page.configuration.matrices`.
 * @returns {{gaps: object[], derivative: Float64Array[], platform: Frame, moves: Float64Array[], frames: Frame[]}} of each
 * cut joint how far it is from closing its loop, and six rows of rates of its gap for each joint value, velocities first;
 * the platform at its point, and six rows of its rates for each joint value, angular velocities first; all links
 */
export function configurationAt(model, values) {
  const { count, cut, links } = model;
  const shapes = [[cut.length, 12], [6 * cut.length, count], [1, 12], [6, count], [links.length, 12]];
  const numbers = new Float64Array(shapes.reduce((size, [length, width]) => size + length * width, 0));
  model.program(stateOf(model, values), model.dimensions, numbers);
  let start = 0;
  const row = (width) => numbers.subarray(start, (start += width));
  const rows = shapes.map(([length, width]) => Array.from({ length }, () => row(width)));
  const [gaps, derivative, platform, moves, frames] = rows;
  const gapOf = (own) => ({ distance: own.subarray(0, 3), turn: own.subarray(3) });
  return { gaps: gaps.map(gapOf), derivative, platform: frameOf(platform[0]), moves, frames: frames.map(frameOf) };
}

const frameOf = (row) => ({ turn: row.subarray(0, 9), origin: row.subarray(9) });

/** What a function says of a model, worked out once. */
export function once(call) {
  const known = new WeakMap();
  return (model) => known.get(model) ?? known.set(model, call(model)).get(model);
}
