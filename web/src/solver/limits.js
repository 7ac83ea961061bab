/** Strokes, joint limits and cones of the file: which of them an assembly exceeds, and by how much. */

import { apply, cross, dot, fromVector, nearestTurn, norm } from "./rotation.js";

const SPARE = 1e-9; // rad, or of the model's length: what rounding may make of a bound

/** @typedef {{kind: "stroke"|"limit", name: string, angle: boolean, low: number, high: number,
 * value: (values: number[]) => number, counted: (values: number[]) => number}} Limit value: angles that are the same
 * after a whole turn are brought near to the middle of their bounds; counted: with their turns */

/** Every bound of the file. @returns {Limit[]} */
export function limitsOf(model) {
  const found = [];
  const add = (kind, name, angle, turns, ends, value) => {
    const [low, high] = [ends[0] ?? -Infinity, ends[1] ?? Infinity];
    const middle = (low + high) / 2;
    const near = (v) => middle + nearestTurn(value(v) - middle);
    found.push({ kind, name, angle, low, high, value: turns && Number.isFinite(middle) ? near : value, counted: value });
  };
  for (const { name, index, kind, stroke, counted, sign, offset } of model.inputs)
    if (stroke) add("stroke", name, kind !== "length", kind !== "length" && !counted, stroke, (v) => sign * v[index] + offset);
  for (const joint of model.joints) {
    if (typeof joint.cone === "number") add("limit", joint.name, true, false, [null, joint.cone], (v) => tilt(joint, v));
    joint.limits.forEach((limit, k) => {
      const index = joint.first + k;
      const { kind, counted } = model.coordinates[index];
      if (limit) add("limit", joint.name, kind !== "length", kind !== "length" && !counted, limit, (v) => v[index]);
    });
  }
  return found;
}

/** The bounds that an assembly exceeds, the one that is exceeded most first. @param {number[]} values */
export function exceeded(model, values) {
  const found = limitsOf(model).map(({ name, angle, low, high, value }) => {
    const here = value(values);
    return { name, angle, by: Math.max(low - here, here - high), unit: angle ? 1 : model.length };
  });
  return found.filter(({ by, unit }) => by > SPARE * unit).sort((a, b) => b.by / b.unit - a.by / a.unit);
}

/** How far a ball joint tilts the axis of its cone. */
function tilt(joint, values) {
  const tilted = apply(fromVector(values.slice(joint.first, joint.first + 3)), joint.coneAxis);
  return Math.atan2(norm(cross(tilted, joint.coneAxis)), dot(tilted, joint.coneAxis));
}
