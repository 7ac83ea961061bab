/** First-order numbers: how inputs move the pose, how near that is to singular, and how far the singularity is. */

import { closureRows, scaledPoseRates } from "./closure.js";
import { frames, screws } from "./frames.js";
import { determinant, nullSpace, singular } from "./leastsquares.js";
import { nearAssembly } from "./newton.js";
import { isLength, poseOf } from "./pose.js";

/** A measure below this is 0: rounding alone leaves some 1e-14. */
export const ZERO = 1e-12;
const RANK = 1e-8; // motions that move neither pose nor inputs by more stand still
const BEND = 4; // a way of tangents bends away from its chord by at most so many squares of its length
const SHARES = [0.5, 0.25, 0.75, 0.125, 0.875]; // of a step, where its chord is looked at
const STEPS = [1e-4, 1e-6, 1e-8]; // of the model's length

/** A basis of all motions at an assembly, scaled rates of the joint values, and the pair that belongs to each of them. */
function pairsAt(model, values) {
  const placed = frames(model, values);
  const twists = screws(model, placed, values);
  const free = nullSpace(closureRows(model, placed, twists), model.count);
  const rows = scaledPoseRates(model, placed, twists);
  for (const { index, sign } of model.inputs) rows.push(model.scale.map((_, k) => (k === index ? sign : 0)));
  const pairs = free.map((motion) => rows.map((row) => row.reduce((sum, value, k) => sum + value * motion[k], 0)));
  return { free, rows, pairs };
}

/**
 * All motions at an assembly: an orthonormal basis of the pairs (rates of the pose, rates of the inputs) that its
 * loops allow, lengths in units of the model's length. Nothing is solved, so it is exact at singularities too.
 * @typedef {{pose: number[][], inputs: number[][], passive: number}} Motions rows of r numbers: one for each rate of the
 * pose; each input; and how much of its least pair a motion has: none where a leg moves between input and platform alone
 * @returns {Motions}
 */
export function motionsAt(model, values) {
  const { rows, pairs } = pairsAt(model, values);
  if (!pairs.length) return { pose: [], inputs: [], passive: 0 };
  const { values: sizes, right } = singular(pairs);
  const basis = right.filter((_, k) => sizes[k] > RANK * Math.max(1, sizes[0]));
  const turned = rows.map((_, k) => basis.map((pair) => pair[k]));
  return {
    pose: turned.slice(0, -model.inputs.length),
    inputs: turned.slice(-model.inputs.length),
    passive: basis.length ? sizes[basis.length - 1] : 0,
  };
}

/**
 * What the motions say of singularities. Where Jp v = Jq qdot, their singular values are those of Jp and Jq of
 * orthonormal relations; s/c of the two are those of the map from the inputs' rates to the pose's.
 * @param {Motions} motions
 * @returns {{condition: number, parallel: number, serial: number, sign: number}} sign: of the map's determinant, 0 if
 * it is not square
 */
export function measures({ pose, inputs }) {
  if (!inputs[0]?.length) return { condition: Infinity, parallel: 0, serial: 0, sign: 0 };
  const [held, moved] = [inputs, pose].map(sizes);
  const [parallel, serial] = [held.at(-1), moved.at(-1)];
  const square = inputs.length === inputs[0].length && pose.length === inputs.length;
  return {
    condition: parallel > 0 && serial > 0 ? (moved[0] / parallel) * (held[0] / serial) : Infinity,
    parallel,
    serial,
    sign: square ? Math.sign(determinant(pose)) * Math.sign(determinant(inputs)) : 0,
  };
}

/** Singular values of rows of r numbers, r of them; rounding is 0. */
const sizes = (rows) => singular(rows).values.map((value) => (value > ZERO ? value : 0));

/**
 * Motions and their measures at joint values.
 * @typedef {Motions & ReturnType<typeof measures>} Measured
 * @returns {Measured}
 */
export function measuresAt(model, values) {
  const motions = motionsAt(model, values);
  return { ...motions, ...measures(motions) };
}

/** The input that moves most where the platform moves least: at a serial singularity its leg is stretched or folded. */
export function looseInput({ pose, inputs }) {
  if (!pose.length) return 0;
  const still = singular(pose).right.at(-1);
  const amounts = inputs.map((row) => Math.abs(row.reduce((sum, value, k) => sum + value * still[k], 0)));
  return amounts.indexOf(Math.max(...amounts));
}

/** The joint that moves most where input and platform move least: it is in the leg that is stretched or folded. */
export function looseJoint(model, values) {
  const { free, pairs } = pairsAt(model, values);
  if (!pairs.length) return model.joints[0];
  const { values: sizes, left } = singular(pairs);
  const least = sizes.findLastIndex((size) => size > RANK * Math.max(1, sizes[0]));
  const moved = model.scale.map((_, k) => Math.abs(free.reduce((sum, motion, i) => sum + motion[k] * left[least][i], 0)));
  const index = moved.indexOf(Math.max(...moved));
  return model.joints.find(({ first, freedoms }) => index >= first && index < first + freedoms);
}

/**
 * Whether a measure keeps away from 0 between two assemblies, and its sign at the second one, positive at the first.
 *
 * Motions there are written over those here, so that they change as little as can be. Between, they lie on their chord
 * but for `BEND` squares of its length in the middle, less towards the ends; a singular value changes by no more than
 * its matrix.
 * @param {Measured} here @param {Measured} there
 * @param {"parallel"|"serial"} kind
 * @returns {{kept: boolean, sense: number}} sense: 1 or -1, 0 where that is not to be said
 */
export function passage(here, there, kind) {
  const part = kind === "parallel" ? "inputs" : "pose";
  const count = here[part][0]?.length ?? 0;
  if (!count || there[part][0]?.length !== count) return { kept: false, sense: 0 };
  const end = alignedTo(here, there);
  const square = here[part].length === count;
  const sign = (rows) => (square ? Math.sign(determinant(rows)) : 1);
  const [first, last] = [here[kind] > 0 ? sign(here[part]) : 0, sign(end[part])]; // 0: both ways are free
  const bend = BEND * end.away ** 2;
  const clear = (t) => {
    const middle = here[part].map((row, i) => row.map((value, k) => value + t * (end[part][i][k] - value)));
    return sizes(middle).at(-1) > 4 * bend * t * (1 - t) && sign(middle) === last;
  };
  const far = here[kind] + there[kind] > end.away + 2 * bend;
  return { kept: first * last >= 0 && (far || SHARES.every(clear)), sense: first * last };
}

/** Motions in the basis nearest to another one (the orthogonal factor of their product), and how far they are. */
function alignedTo(here, there) {
  const rows = [...here.pose, ...here.inputs];
  const others = [...there.pose, ...there.inputs];
  const count = rows[0].length;
  const product = Array.from({ length: count }, (_, i) =>
    Array.from({ length: count }, (_, j) => rows.reduce((sum, row, k) => sum + row[i] * others[k][j], 0)),
  );
  const { values, left, right } = singular(product);
  const turn = Array.from({ length: count }, (_, j) =>
    Array.from({ length: count }, (_, i) => values.reduce((sum, _, k) => sum + right[k][j] * left[k][i], 0)),
  );
  const turned = (part) =>
    part.map((row) => turn.map((_, i) => row.reduce((sum, value, j) => sum + value * turn[j][i], 0)));
  return {
    pose: turned(there.pose),
    inputs: turned(there.inputs),
    away: Math.sqrt(2 * Math.max(0, 1 - values.at(-1))),
  };
}

/**
 * First-order distance to the nearest singularity, the orientation held: a measure over its steepest change along the
 * pose's lengths. The parallel one is taken with its sign, for it goes through zero; the serial one is squared, so that
 * it falls evenly to zero where two working modes meet and the reach ends.
 * @returns {{amount: number, kind: "parallel"|"serial"}} in length units; NaN where the pose has no lengths
 */
export function distanceToSingular(model, values) {
  const pose = poseOf(model, frames(model, values));
  const found = measuresAt(model, values);
  const { parallel, serial } = found;
  const lengths = pose.map((_, k) => k).filter((k) => isLength(model.pose[k]));
  if (!lengths.length) return { amount: NaN, kind: "parallel" };
  if (parallel === 0 || serial === 0) return { amount: 0, kind: parallel === 0 ? "parallel" : "serial" };
  const reached = (k, shift) => {
    const wanted = pose.map((value, j) => (j === k ? value + shift : value));
    const near = nearAssembly(model, values, [], wanted);
    if (!near) return null;
    const there = measuresAt(model, near);
    return [there.parallel * (passage(found, there, "parallel").sense || 1), there.serial ** 2];
  };
  const here = [parallel, serial ** 2];
  const slopes = [0, 0];
  for (const k of lengths)
    for (const step of STEPS.map((share) => share * model.length)) {
      const [ahead, behind] = [reached(k, step), reached(k, -step)];
      if (!ahead && !behind) continue; // nearer to a border than that
      const span = ahead && behind ? 2 * step : step;
      slopes.forEach((_, j) => (slopes[j] += (((ahead ?? here)[j] - (behind ?? here)[j]) / span) ** 2));
      break;
    }
  const far = here.map((value, j) => (slopes[j] > 0 ? value / Math.sqrt(slopes[j]) : Infinity));
  return far[0] <= far[1] ? { amount: far[0], kind: "parallel" } : { amount: far[1], kind: "serial" };
}
