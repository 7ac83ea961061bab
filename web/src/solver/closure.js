/**
 * Loop closure: the gaps of the cut joints and their derivative, as in `assur.kinematics.closure`.
 *
 * At every cut joint the child's frame is reached twice, through the joint and along the tree. A gap is three
 * lengths, and the rotation vector between the two frames times the mechanism's characteristic length.
 */

import { configurationAt } from "./configuration.js";
import { poseError, poseRates } from "./pose.js";
import { norm, times, toVector, vectorRates } from "./rotation.js";

/** @returns {number[]} six numbers for each cut joint */
export const gaps = (model, at) =>
  at.gaps.flatMap(({ distance, turn }) => [...distance, ...times(model.length, toVector(turn))]);

/** The largest gap in length units, and the cut joint that has it. @returns {{amount: number, joint: string}} */
export function largestGap(model, values) {
  const found = { amount: 0, joint: "" };
  const rows = gaps(model, configurationAt(model, values));
  model.cut.forEach((k, index) => {
    const at = 6 * index;
    const amount = Math.max(norm(rows.slice(at, at + 3)), norm(rows.slice(at + 3, at + 6)));
    if (amount > found.amount) Object.assign(found, { amount, joint: model.joints[k].name });
  });
  return found;
}

/** @returns {number} largest gap at joint values, in length units */
export const residual = (model, values) => largestGap(model, values).amount;

/** Gaps and their derivative, both in units of the model's length, unknowns scaled likewise.
 * @param {number[]|null} wanted a pose whose error is added as rows
 * @returns {{rows: number[], matrix: Float64Array[]}} matrix: one array of n per row */
export function closingSystem(model, values, wanted, weight = 1) {
  const at = configurationAt(model, values);
  const rows = gaps(model, at).map((value) => value / model.length);
  const matrix = closureRows(model, at);
  if (wanted) {
    rows.push(...poseError(model, at, wanted).map((value) => (weight * value) / model.length));
    matrix.push(...poseRates(model, at).map((row) => row.map((value) => weight * value)));
  }
  return { rows, matrix };
}

/** Derivative of the gaps, exact also where loops are open: lengths in units of the model's length, gaps and unknowns. */
export function closureRows(model, { gaps, derivative }) {
  const { count, scale, length } = model;
  return gaps.flatMap(({ turn }, index) => {
    const given = derivative.slice(6 * index, 6 * index + 6);
    const [, , , x, y, z] = given;
    const rates = vectorRates(toVector(turn));
    const rows = given.map(() => new Float64Array(count));
    for (let k = 0; k < count; k++)
      for (let i = 0; i < 3; i++) {
        rows[i][k] = (given[i][k] * scale[k]) / length;
        rows[i + 3][k] = (rates[3 * i] * x[k] + rates[3 * i + 1] * y[k] + rates[3 * i + 2] * z[k]) * scale[k];
      }
    return rows;
  });
}
