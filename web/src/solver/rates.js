/** First-order numbers: how inputs move the pose, how near that is to singular, and how far the singularity is. */

import { closureRows, scaledPoseRates } from "./closure.js";
import { frames, screws } from "./frames.js";
import { determinant, leastSquares, singular } from "./leastsquares.js";
import { nearAssembly } from "./newton.js";
import { isLength, poseOf } from "./pose.js";

const DAMPING = 1e-9;
const STEPS = [1e-4, 1e-6, 1e-8]; // of the model's length

/**
 * The map from inputs' rates to the pose's, lengths in units of the model's length; joint motions that move neither
 * stand still.
 * @returns {number[][]} as many rows as the pose has rates, a column for each input
 */
export function inputMap(model, values) {
  const placed = frames(model, values);
  const twists = screws(model, placed, values);
  const matrix = closureRows(model, placed, twists);
  const loops = matrix.length;
  for (const input of model.inputs) {
    const row = new Float64Array(model.count);
    row[input.index] = input.sign;
    matrix.push(row);
  }
  const right = model.inputs.map((_, k) => Float64Array.from(matrix, (_, i) => (i === loops + k ? 1 : 0)));
  const rates = leastSquares(matrix, right, DAMPING);
  return scaledPoseRates(model, placed, twists).map((row) =>
    rates.map((rate) => rate.reduce((sum, value, k) => sum + value * row[k], 0)),
  );
}

/**
 * What the map says of singularities. With (Jp, -Jq) an orthonormal basis of the relations Jp v = Jq qdot, the
 * singular values of Jp are 1/sqrt(1 + s^2) and those of Jq s/sqrt(1 + s^2), for the singular values s of the map.
 * @returns {{condition: number, parallel: number, serial: number, sign: number}} sign: of its determinant, 0 if not square
 */
export function measures(map) {
  const tall = map.length >= map[0].length ? map : map[0].map((_, j) => map.map((row) => row[j]));
  const { values } = singular(tall);
  const most = values[0];
  const least = values[values.length - 1];
  return {
    condition: least > 0 ? most / least : Infinity,
    parallel: 1 / Math.hypot(1, most),
    serial: least / Math.hypot(1, least),
    sign: map.length === map[0].length ? Math.sign(determinant(map)) : 0,
  };
}

/** @returns measures at joint values */
export const measuresAt = (model, values) => measures(inputMap(model, values));

/**
 * First-order distance to the nearest singularity, the orientation held: a measure over its steepest change along the
 * pose's lengths. The serial one is squared, so that it falls evenly to zero where two working modes meet.
 * @returns {{amount: number, kind: "parallel"|"serial"}} in length units; NaN where the pose has no lengths
 */
export function distanceToSingular(model, values) {
  const pose = poseOf(model, frames(model, values));
  const both = ({ parallel, serial }) => [parallel, serial ** 2];
  const here = both(measuresAt(model, values));
  const steps = pose.map((_, k) => k).filter((k) => isLength(model.pose[k]));
  const slopes = [0, 0];
  for (const k of steps) {
    const reached = (shift) => {
      const there = nearAssembly(
        model,
        values,
        [],
        pose.map((value, j) => (j === k ? value + shift : value)),
      );
      return there && both(measuresAt(model, there));
    };
    for (const step of STEPS.map((share) => share * model.length)) {
      const [ahead, behind] = [reached(step), reached(-step)];
      if (!ahead && !behind) continue; // nearer to a border than that
      slopes.forEach(
        (_, j) =>
          (slopes[j] += (((ahead || here)[j] - (behind || here)[j]) / (ahead && behind ? 2 * step : step)) ** 2),
      );
      break;
    }
  }
  if (!steps.length) return { amount: NaN, kind: "parallel" };
  const [parallel, serial] = here.map((value, j) => (slopes[j] > 0 ? value / Math.sqrt(slopes[j]) : Infinity));
  return parallel <= serial ? { amount: parallel, kind: "parallel" } : { amount: serial, kind: "serial" };
}
