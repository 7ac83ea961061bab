/** Courses for the player: a circle of the platform, and everything to and fro, of a stated size well inside reach. */

import { greek, shownUnit } from "./dom.js";
import { rangeOf, roundBelow } from "./ends.js";
import { isLength, poseOfShown, shownPose } from "./solver/pose.js";
import { toInputs, toPose } from "./solver/motion.js";

const SAMPLES = 60;
const RADIUS = 1 / 6; // of the shorter slider, at most
const TRAVEL = 0.45; // of the slider, at most
const WIDEST = (2 * Math.PI) / 3; // rad of an angle's slider that count
const CLEAR = 1.25; // a course that is so much larger can be followed too
const ROUGH = 20; // places at which that is asked
const SIZES = 5; // that are tried, each a round number

/** @typedef {{name: (size: number) => string, amount: (size: number) => string, kind: "pose"|"inputs",
 * sizes: number[], ways: number, at: (t: number, size: number, way: number) => number[]}} Course
 * closed, t from 0 to 1; it starts where the mechanism stands, `ways` are the sides to which it may lie, sizes fall */

/** To and fro over 1 from where it starts: to both sides, or to one of them. */
const SWINGS = [
  (angle) => Math.sin(angle) / 2,
  (angle) => (1 - Math.cos(angle)) / 2,
  (angle) => (Math.cos(angle) - 1) / 2,
];

/** A circle of radius 1 through where it starts, its centre on one of four sides. */
function round(angle, way) {
  const start = (way * Math.PI) / 2;
  return [Math.cos(angle + start) - Math.cos(start), Math.sin(angle + start) - Math.sin(start)];
}

/** Round numbers from one down, as they are shown. @returns {number[]} */
function sizesFrom(most) {
  const found = [roundBelow(most)];
  while (found.length < SIZES) found.push(roundBelow(0.6 * found.at(-1)));
  return found;
}

/** Pairs of coordinates that circles lie in, those of the widest sliders first: lengths if there are two, else angles. */
function planes(names, room) {
  const of = (length) => names.flatMap((name, k) => (isLength(name) === length ? [k] : []));
  const found = of(true).length > 1 ? of(true) : of(false);
  const pairs = found.flatMap((one, k) => found.slice(k + 1).map((other) => [one, other]));
  const width = ([one, other]) => room(one) * room(other);
  return pairs.sort((a, b) => width(b) - width(a));
}

/** Courses from where the mechanism stands: circles first, if there are any. @returns {Course[]} */
export function coursesOf(mechanism) {
  const { model, scene } = mechanism;
  const { names, values } = shownPose(model, mechanism.pose);
  const inputs = mechanism.inputs;
  const span = (length, [low, high]) => (length ? high - low : Math.min(WIDEST, high - low));
  const room = (k) => span(isLength(names[k]), rangeOf(names[k], mechanism));
  const course = (words, length, most, rest) => {
    const { factor, unit } = shownUnit(scene, length);
    const sizes = sizesFrom(most * factor).map((size) => size / factor);
    const amount = (size) => `${Number((size * factor).toPrecision(3))}${unit === "°" ? unit : ` ${unit}`}`;
    return { amount, name: (size) => `${greek(words)} ${amount(size)}`, sizes, ...rest };
  };
  const pose = (ways, change) => ({
    kind: "pose",
    ways,
    at: (t, size, way) => {
      const shown = values.map((value, k) => value + size * change(2 * Math.PI * t, way, k));
      return poseOfShown(model, shown);
    },
  });
  const circle = (pair) =>
    course(
      `circle in ${pair.map((k) => names[k]).join(" and ")}, radius`,
      isLength(names[pair[0]]),
      RADIUS * Math.min(...pair.map(room)),
      pose(4, (angle, way, k) => (pair.includes(k) ? round(angle, way)[pair.indexOf(k)] : 0)),
    );
  const swing = (name, j) => {
    const rest = pose(SWINGS.length, (angle, way, k) => (k === j ? SWINGS[way](angle) : 0));
    return course(`${name} to and fro,`, isLength(name), TRAVEL * room(j), rest);
  };
  const input = (item, j) => {
    const length = item.kind === "length";
    const change = (t, size, way) => size * SWINGS[way](2 * Math.PI * t);
    const at = (...given) => inputs.map((value, k) => (k === j ? value + change(...given) : value));
    const rest = { kind: "inputs", ways: SWINGS.length, at };
    return course(`input ${item.name} to and fro,`, length, TRAVEL * span(length, item.range), rest);
  };
  return [...planes(names, room).map(circle), ...names.map(swing), ...scene.inputs.map(input)];
}

/** Where a mechanism is asked to be. */
const go = ({ kind }, mechanism, values, target) =>
  (kind === "pose" ? toPose : toInputs)(mechanism.model, values, target, mechanism);

/** A course followed once round at so many places. @returns {{samples: number[][], reason: object|null}} as far as it goes */
function around(mechanism, course, size, way, count) {
  const samples = [mechanism.values];
  for (let k = 1; k <= count; k++) {
    const { status, values, reason } = go(course, mechanism, samples[k - 1], course.at(k / count, size, way));
    if (status !== "moved") return { samples, reason };
    samples.push(values);
  }
  return { samples, reason: null };
}

/** A course followed once round from where the mechanism stands, as large as it can be with room around it.
 * @returns {{size: number, way: number, samples: number[][]}|{reason: object}} values at even times; why no size works */
export function followedCourse(mechanism, course) {
  let reason = null;
  for (const size of course.sizes)
    for (let way = 0; way < course.ways; way++) {
      ({ reason } = around(mechanism, course, CLEAR * size, way, ROUGH));
      if (reason) continue;
      const found = around(mechanism, course, size, way, SAMPLES);
      if (!found.reason) return { size, way, samples: found.samples };
      reason = found.reason;
    }
  return { reason };
}

/** The configuration at a time from 0 to 1. @returns {{values: number[]}} */
export function onCourse(mechanism, course, { size, way, samples }, t) {
  return go(course, mechanism, samples[Math.round(t * SAMPLES)], course.at(t, size, way));
}
