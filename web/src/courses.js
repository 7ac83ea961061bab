/** Courses for the player: a circle of the platform, and every input to and fro, made small enough to be followed. */

import { isLength, poseOfShown, shownPose } from "./solver/pose.js";
import { toInputs, toPose } from "./solver/motion.js";

const SAMPLES = 60;
const AWAY = 0.15; // of the time goes into the way to a circle, and back
const SMALLEST = 1 / 16;

/**
 * @typedef {{label: string, kind: "pose"|"inputs", ways: number, at: (t: number, size: number, way: number) => number[]}} Course
 * closed, t from 0 to 1; it starts where the mechanism stands, and `ways` are the sides to which it may lie
 */

/** To and fro from where it starts: to both sides, or to one of them. */
const SWINGS = [Math.sin, (angle) => (1 - Math.cos(angle)) / 2, (angle) => (Math.cos(angle) - 1) / 2];

/** A circle through where it starts, its centre on one of four sides. */
function round(angle, way) {
  const turned = angle + (way * Math.PI) / 2;
  const start = (way * Math.PI) / 2;
  return [Math.cos(turned) - Math.cos(start), Math.sin(turned) - Math.sin(start)];
}

/** Courses about a configuration: first a circle about the middle of the sliders, or one near where it stands. @returns {Course[]} */
export function coursesOf(mechanism) {
  const { model, scene } = mechanism;
  const { names, values } = shownPose(model, mechanism.pose);
  const inputs = mechanism.inputs;
  const reach = (name) => (isLength(name) ? 0.22 * scene.extent : 0.6);
  const pose = (label, ways, change) => ({
    label,
    kind: "pose",
    ways,
    at: (t, size, way) =>
      poseOfShown(
        model,
        values.map((value, k) => value + size * reach(names[k]) * change(2 * Math.PI * t, way, k)),
      ),
  });
  const swing = (label, j) => pose(label, SWINGS.length, (angle, way, k) => (k === j ? SWINGS[way](angle) : 0));
  const input = (item, j) => {
    const half = 0.35 * (item.range[1] - item.range[0]);
    const at = (t, size, way) =>
      inputs.map((value, k) => (k === j ? value + size * half * SWINGS[way](2 * Math.PI * t) : value));
    return { label: `input ${item.name} to and fro`, kind: "inputs", ways: SWINGS.length, at };
  };
  const middle = names.map((name, k) => {
    const [low, high] = scene.poseRange[model.pose.indexOf(name)] ?? [values[k], values[k]];
    return isLength(name) ? { at: (low + high) / 2, half: (high - low) / 2 } : { at: values[k], half: reach(name) };
  });
  const tour = (t, size) => {
    const [share, angle] = [Math.min(1, t / AWAY, (1 - t) / AWAY), (2 * Math.PI * (t - AWAY)) / (1 - 2 * AWAY)];
    const smooth = share * share * (3 - 2 * share);
    const on = middle.map(
      ({ at, half }, k) => at + (k === 0 ? size * half * Math.cos(angle) : k === 1 ? size * half * Math.sin(angle) : 0),
    );
    return poseOfShown(
      model,
      values.map((value, k) => value + smooth * (on[k] - value)),
    );
  };
  const near = pose("", 4, (angle, way, k) => (k < 2 ? round(angle, way)[k] : 0));
  const label = `circle of ${names[0]} and ${names[1]}`;
  const circle =
    names.length > 1
      ? [
          {
            label,
            kind: "pose",
            ways: 5,
            at: (t, size, way) => (way === 0 ? tour(t, 0.8 * size) : near.at(t, size, way - 1)),
          },
        ]
      : [];
  return [...circle, ...names.map((name, j) => swing(`${name} to and fro`, j)), ...scene.inputs.map(input)];
}

/** Where a mechanism is asked to be. */
const go = ({ kind }, mechanism, values, target) =>
  (kind === "pose" ? toPose : toInputs)(mechanism.model, values, target, mechanism);

/**
 * A course followed once round from where the mechanism stands, as large as it can be.
 * @param {Course} course
 * @returns {{size: number, way: number, samples: number[][]}|null} joint values at even times; null where none works
 */
export function followedCourse(mechanism, course) {
  for (let size = 1; size >= SMALLEST; size *= 0.6)
    for (let way = 0; way < course.ways; way++) {
      const samples = [mechanism.values];
      for (let k = 1; k <= SAMPLES; k++) {
        const found = go(course, mechanism, samples[k - 1], course.at(k / SAMPLES, size, way));
        if (found.status !== "moved") break;
        samples.push(found.values);
      }
      if (samples.length === SAMPLES + 1) return { size, way, samples };
    }
  return null;
}

/** The configuration at a time from 0 to 1. @returns {{values: number[]}} */
export function onCourse(mechanism, course, { size, way, samples }, t) {
  return go(course, mechanism, samples[Math.round(t * SAMPLES)], course.at(t, size, way));
}
