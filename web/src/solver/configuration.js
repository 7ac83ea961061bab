/**
 * The joint graph at joint values: frames of its links, gaps of its loops, twists.
 *
 * They are worked out by a program that Python has written from the one joint graph (`assur.page.configuration`). What
 * is left here is where the steps stand that joints are made of: lengths, cosines and sines, quaternions.
 */

import { leftJacobian, quaternionOf } from "./rotation.js";

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
  const { graph, coordinates, inputs, unit, home, characteristicLength: length } = scene;
  const place = (name) => graph.links.indexOf(name);
  const balls = graph.steps.filter(({ kind }) => kind === "ball");
  return {
    ...graph,
    program: scene.configuration,
    joints: graph.joints.map((joint) => ({ ...joint, parent: place(joint.parent), child: place(joint.child) })),
    balls: balls.map(({ first }) => first),
    coordinates,
    inputs,
    pose: scene.platform.pose,
    home,
    count: home.length,
    unit,
    length,
    scale: coordinates.map(({ kind }) => (kind === "length" ? length : 1)),
    units: coordinates.map(({ size }) => size),
  };
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
 * Everything that is asked of joint values; loops need not close. What is not asked for takes no time.
 *
 * It is written row by row into one list, in the order of `assur.page.configuration.matrices`.
 */
class Configuration {
  constructor(model, values) {
    const [loops, count, links] = [model.cut.length, model.count, model.links.length];
    const sizes = { gap: 12 * loops, derivative: 6 * loops * count, platform: 12, move: 6 * count, frame: 12 * links };
    let size = 0;
    this.starts = {};
    for (const [name, own] of Object.entries(sizes)) [this.starts[name], size] = [size, size + own];
    Object.assign(this, { loops, count, links, numbers: new Float64Array(size) });
    model.program(stateOf(model, values), model.dimensions, this.numbers);
  }

  rows(name, length, width) {
    const start = this.starts[name];
    return Array.from({ length }, (_, k) => this.numbers.subarray(start + k * width, start + (k + 1) * width));
  }

  /** Of each cut joint how far it is from closing its loop. */
  get gaps() {
    return this.rows("gap", this.loops, 12).map((row) => ({ distance: row.subarray(0, 3), turn: row.subarray(3) }));
  }

  /** Six rows for each cut joint: rates of its gap for each joint value, velocities first. @returns {Float64Array[]} */
  get derivative() {
    return this.rows("derivative", 6 * this.loops, this.count);
  }

  /** The platform at its point. @returns {Frame} */
  get platform() {
    return frameOf(this.rows("platform", 1, 12)[0]);
  }

  /** Six rows: rates of the platform for each joint value, angular velocities first. @returns {Float64Array[]} */
  get moves() {
    return this.rows("move", 6, this.count);
  }

  /** Frames of all links. @returns {Frame[]} */
  get frames() {
    return this.rows("frame", this.links, 12).map(frameOf);
  }
}

const frameOf = (row) => ({ turn: row.subarray(0, 9), origin: row.subarray(9) });

/** @returns {Configuration} */
export const configurationAt = (model, values) => new Configuration(model, values);

/** What a function says of a model, worked out once. */
export function once(call) {
  const known = new WeakMap();
  return (model) => known.get(model) ?? known.set(model, call(model)).get(model);
}
