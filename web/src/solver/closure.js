/**
 * Loop closure: the gaps of the cut joints and their derivative by screws, as in `assur.kinematics.closure`.
 *
 * At every cut joint the child's frame is reached twice, through the joint and along the tree. A gap is three
 * lengths, and the rotation vector between the two frames times the mechanism's characteristic length.
 */

import { childFrame, frames, screws } from "./frames.js";
import { poseError, poseRates, rateNames, isLength } from "./pose.js";
import { add, apply, cross, multiply, norm, subtract, times, toVector, transpose } from "./rotation.js";

/** @returns {number[]} six numbers for each cut joint */
export function gaps(model, placed, values) {
  const rows = [];
  for (const k of model.cut) {
    const joint = model.joints[k];
    const reached = childFrame(joint, placed[joint.parent], values);
    const { turn, origin } = placed[joint.child];
    const error = subtract(
      add(apply(reached.turn, joint.childAt), reached.origin),
      add(apply(turn, joint.childAt), origin),
    );
    rows.push(...error, ...times(model.length, toVector(multiply(reached.turn, transpose(turn)))));
  }
  return rows;
}

/** The largest gap in length units, and the cut joint that has it. @returns {{amount: number, joint: string}} */
export function largestGap(model, rows) {
  const found = { amount: 0, joint: "" };
  model.cut.forEach((k, index) => {
    const at = 6 * index;
    const amount = Math.max(norm(rows.slice(at, at + 3)), norm(rows.slice(at + 3, at + 6)));
    if (amount > found.amount) Object.assign(found, { amount, joint: model.joints[k].name });
  });
  return found;
}

/** @returns {number} largest gap at joint values, in length units */
export const residual = (model, values) => largestGap(model, gaps(model, frames(model, values), values)).amount;

/**
 * Gaps and their derivative, both in units of the model's length, unknowns scaled likewise.
 * @param {number[]|null} wanted a pose whose error is added as rows
 * @returns {{rows: number[], matrix: Float64Array[], placed: object[], twists: object[]}} matrix: one array of n per row
 */
export function closingSystem(model, values, wanted, weight = 1) {
  const placed = frames(model, values);
  const twists = screws(model, placed, values);
  const rows = gaps(model, placed, values).map((value) => value / model.length);
  const matrix = closureRows(model, placed, twists);
  if (wanted) {
    rows.push(...poseError(model, placed, wanted).map((value) => (weight * value) / model.length));
    matrix.push(...scaledPoseRates(model, placed, twists).map((row) => row.map((value) => weight * value)));
  }
  return { rows, matrix, placed, twists };
}

/** Derivative of the gaps: lengths in units of the model's length, both of gaps and of joint values. */
export function closureRows(model, placed, twists) {
  const matrix = [];
  model.cut.forEach((k, index) => {
    const { child, childAt } = model.joints[k];
    const point = add(apply(placed[child].turn, childAt), placed[child].origin);
    const block = Array.from({ length: 6 }, () => new Float64Array(model.count));
    for (const [name, sense] of model.loops[index]) {
      const { first, freedoms } = model.joints[name];
      for (let column = first; column < first + freedoms; column++) {
        const { angular, linear } = twists[column];
        const velocity = add(linear, cross(angular, point));
        for (let i = 0; i < 3; i++) {
          block[i][column] = (sense * velocity[i] * model.scale[column]) / model.length;
          block[i + 3][column] = sense * angular[i] * model.scale[column];
        }
      }
    }
    matrix.push(...block);
  });
  return matrix;
}

/** Rates of the pose, without dimensions, per scaled rate of the joint values. @returns {Float64Array[]} */
export function scaledPoseRates(model, placed, twists, names = rateNames(model.pose)) {
  return poseRates(model, placed, twists, names).map((row, k) =>
    row.map((value, column) => (value * model.scale[column]) / (isLength(names[k]) ? model.length : 1)),
  );
}
