/** Newton's steps to an assembly: damped least squares, so that redundant loops and free motions do no harm. */

import { closingSystem } from "./closure.js";
import { leastSquares } from "./leastsquares.js";

const TOLERANCE = 1e-13; // of the model's length: a residual that counts as none, as rounding alone leaves some 1e-15
const CLOSED = 1e-10;
const LEAST_DAMPING = 1e-11;
const REACH = 0.3; // the longest first step, without dimensions
const MOST_STEPS = 40;

const size = (rows) => Math.hypot(...rows);
const largest = (rows) => rows.reduce((most, value) => Math.max(most, Math.abs(value)), 0);

/** Values after one step of all but the held ones, and how long it was without dimensions. */
function stepped(model, values, held, system, damping) {
  const free = values.map((_, k) => k).filter((k) => !held.includes(k));
  const matrix = held.length ? system.matrix.map((row) => free.map((k) => row[k])) : system.matrix;
  const step = leastSquares(matrix, system.rows.map((value) => -value), Math.max(LEAST_DAMPING, damping));
  const moved = values.slice();
  free.forEach((k, i) => (moved[k] += step[i] * model.scale[k]));
  return { values: moved, length: largest(step) };
}

/** The assembly next to a start, or null where Newton's steps do not shrink at once: then the start is too far away.
 * @param {number[]} held indices of joint values that stand
 * @param {number[]|null} wanted the pose, or null */
export function nearAssembly(model, start, held, wanted) {
  let values = start;
  let before = Infinity;
  for (let k = 0; k < 12; k++) {
    const system = closingSystem(model, values, wanted);
    const amount = largest(system.rows);
    if (amount <= TOLERANCE) return values;
    const step = stepped(model, values, held, system, Math.min(1e-6, amount * amount));
    if (k === 0 && step.length > REACH) return null;
    if (k > 0 && step.length > 0.25 * before && amount > 1e-11) return null;
    if (k > 2 && step.length > 0.5 * before) return amount <= CLOSED ? values : null; // rounding is all that is left
    before = step.length;
    values = step.values;
  }
  return null;
}

/** The closest approach to an assembly from a start that may be far away (Levenberg and Marquardt).
 * @param {number} weight of the pose's rows: a large one leaves all gaps to the loops
 * @returns {number[]} joint values */
export function closestApproach(model, start, held, wanted, weight = 1) {
  let values = start;
  let system = closingSystem(model, values, wanted, weight);
  let amount = size(system.rows);
  let damping = 1e-2;
  for (let k = 0; k < MOST_STEPS && amount > TOLERANCE; k++) {
    const step = stepped(model, values, held, system, damping);
    const next = closingSystem(model, step.values, wanted, weight);
    const [before, left] = [amount, size(next.rows)];
    if (left < before) {
      [values, system, damping, amount] = [step.values, next, damping / 5, left];
      if (before - left < 1e-9 * left) break;
    } else if ((damping *= 8) > 1e4) break;
  }
  return values;
}
