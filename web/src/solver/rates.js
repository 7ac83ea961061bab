/** First-order numbers: how inputs move the pose, and how near that is to singular. */

import { closureRows } from "./closure.js";
import { configurationAt, once } from "./configuration.js";
import { determinant, dot, nullSpace, singular } from "./leastsquares.js";
import { hasAngles, poseRates } from "./pose.js";

const ZERO = 1e-12; // a measure below this is 0: rounding alone leaves some 1e-14
const RANK = 1e-8; // motions that move neither pose nor inputs by more stand still
const BEND = 4; // a way of tangents bends away from its chord by at most so many squares of its length
const SHARES = [0.5, 0.25, 0.75, 0.125, 0.875]; // of a step, where its chord is looked at
const PARTS = 8; // of a step, in each of which its chord is looked at

/** A basis of all motions at an assembly, scaled rates of the joint values, and the pair that belongs to each of them. */
function pairsAt(model, values, names) {
  const at = configurationAt(model, values);
  const free = nullSpace(closureRows(model, at), model.count);
  const rows = poseRates(model, at, names);
  for (const { index, sign } of model.inputs) rows.push(model.scale.map((_, k) => (k === index ? sign : 0)));
  const pairs = free.map((motion) => rows.map((row) => dot(row, motion)));
  return { free, rows, pairs };
}

/** How many sizes of pairs are not 0. */
const ranked = (sizes) => sizes.filter((size) => size > RANK * Math.max(1, sizes[0])).length;

/** How many pairs the loops allow at home: one fewer is a singularity. */
const pairsAtHome = once((model) => {
  const { pairs } = pairsAt(model, model.home);
  return pairs.length ? ranked(singular(pairs).values) : 0;
});

/**
 * All motions at an assembly: an orthonormal basis of the pairs (rates of the pose, rates of the inputs) that its
 * loops allow, lengths in units of the model's length. Nothing is solved, so it is exact at singularities too.
 * @typedef {{pose: number[][], inputs: number[][], joints: number[][], pairs: number[][], passive: number}} Motions rows
 * of r numbers: one for each rate of the pose; each input; each scaled rate of a joint value, for orthonormal motions of
 * the joints; each number of the pairs that these have; and the least size of the latter, as many as at home: none where
 * a leg moves between input and platform alone
 * @param {string[]} [names] of the rates of the pose, those of `rateNames` if none are given
 */
function motionsAt(model, values, names) {
  const { free, rows, pairs } = pairsAt(model, values, names);
  if (!pairs.length) return { pose: [], inputs: [], joints: [], pairs: [], passive: 0 };
  const { values: sizes, left, right } = singular(pairs);
  const basis = right.slice(0, ranked(sizes));
  const turned = rows.map((_, k) => basis.map((pair) => pair[k]));
  return {
    pose: turned.slice(0, -model.inputs.length),
    inputs: turned.slice(-model.inputs.length),
    joints: model.scale.map((_, k) => basis.map((_, j) => sum(free, (motion, i) => motion[k] * left[j][i]))),
    pairs: turned.map((row) => row.map((value, j) => value * sizes[j])),
    passive: sizes[pairsAtHome(model) - 1] ?? 0,
  };
}

const sum = (items, term) => items.reduce((total, item, k) => total + term(item, k), 0);

/** What the motions say of singularities. Where Jp v = Jq qdot, their singular values are those of Jp and Jq of
 * orthonormal relations; s/c of the two are those of the map from the inputs' rates to the pose's. */
function measures({ pose, inputs }) {
  if (!inputs[0]?.length) return { condition: Infinity, parallel: 0, serial: 0 };
  const [held, moved] = [inputs, pose].map(sizes);
  const [parallel, serial] = [held.at(-1), moved.at(-1)];
  const condition = parallel > 0 && serial > 0 ? (moved[0] / parallel) * (held[0] / serial) : Infinity;
  return { condition, parallel, serial };
}

/** Singular values of rows of r numbers, r of them; rounding is 0. */
const sizes = (rows) => singular(rows).values.map((value) => (value > ZERO ? value : 0));

/** @typedef {Motions & ReturnType<typeof measures>} Measured @returns {Measured} */
export function measuresAt(model, values) {
  const motions = motionsAt(model, values);
  return { ...motions, ...measures(motions) };
}

/** The condition number of the map from the inputs' rates to those of the pose's own coordinates, phi, theta and psi
 * among them: what Python calls that of J. A right angle of theta leaves it without bound. */
export const conditionAt = (model, values) =>
  measures(motionsAt(model, values, hasAngles(model.pose) ? model.pose : undefined)).condition;

/**
 * How near joint values are to a singularity: the measures with screws, and shafts that drive them, in turns that advance
 * them by the model's length. In rad a fine thread would look singular everywhere.
 */
export const nearness = (model, values) => measuresAt(weighed(model), values);
const weighed = once((model) => Object.create(model, { scale: { get: () => model.units } }));

/** The input that moves most where the platform moves least: at a serial singularity its leg is stretched or folded. */
export function looseInput({ pose, inputs }) {
  if (!pose.length) return 0;
  const still = singular(pose).right.at(-1);
  const amounts = inputs.map((row) => Math.abs(dot(row, still)));
  return amounts.indexOf(Math.max(...amounts));
}

/** The joint that moves most where input and platform move least: it is in the leg that is stretched or folded. */
export function looseJoint(model, values) {
  const { free, rows, pairs } = pairsAt(model, values);
  if (!pairs.length) return model.joints[0];
  const { right } = singular(rows.map((_, k) => pairs.map((pair) => pair[k]))); // unit vectors, also where a size is 0
  const least = right[Math.max(0, pairsAtHome(model) - 1)] ?? right.at(-1);
  const moved = model.scale.map((_, k) => Math.abs(sum(free, (motion, i) => motion[k] * least[i])));
  const index = moved.indexOf(Math.max(...moved));
  return model.joints.find(({ first, freedoms }) => index >= first && index < first + freedoms);
}

/** Rows whose least size a measure is, and those of the orthonormal motions that they belong to. */
const ROWS = {
  parallel: ({ pose, inputs }) => [inputs, [...pose, ...inputs]],
  serial: ({ pose, inputs }) => [pose, [...pose, ...inputs]],
  passive: ({ pairs, joints }) => [pairs, joints],
};

/**
 * Whether a measure keeps away from 0 between two assemblies, and its sign at the second one, positive at the first.
 *
 * Motions there are written over those here, so that they change as little as can be. Between, they lie on their chord
 * but for `BEND` squares of its length in the middle, less towards the ends; a singular value changes by no more than
 * its matrix. Where that matrix is not square, as that of passive legs, no determinant tells the sides of 0 apart: there
 * the chord, or each part of it, has to change by less than the measures at both its ends together.
 * @param {Measured} here @param {Measured} there @param {"parallel"|"serial"|"passive"} kind
 * @returns {{kept: boolean, sense: number}} sense: 1 or -1, 0 where that is not to be said
 */
export function passage(here, there, kind) {
  const [[rows, motions], [others, otherMotions]] = [here, there].map(ROWS[kind]);
  const count = rows[0]?.length ?? 0;
  if (!count || others[0]?.length !== count) return { kept: false, sense: 0 };
  const { turn, away } = nearest(motions, otherMotions);
  const end = others.map((row) => turn.map((column) => dot(row, column)));
  const change = end.map((row, i) => row.map((value, k) => value - rows[i][k]));
  const square = rows.length === count;
  const sign = (matrix) => (square ? Math.sign(determinant(matrix)) : 1);
  const [first, last] = [here[kind] > 0 ? sign(rows) : 0, sign(end)]; // 0: both ways are free
  const bend = BEND * away ** 2;
  const at = (t) => rows.map((row, i) => row.map((value, k) => value + t * change[i][k]));
  const clear = (t) => sizes(at(t)).at(-1) > 4 * bend * t * (1 - t) && sign(at(t)) === last;
  const most = sizes(change)[0];
  const far = (parts) => {
    const found = Array.from({ length: parts + 1 }, (_, k) => sizes(at(k / parts)).at(-1));
    return found.every((value, k) => k === 0 || found[k - 1] + value > most / parts + 2 * bend);
  };
  const free = here[kind] + there[kind] > most + 2 * bend || (square ? SHARES.every(clear) : far(PARTS));
  return { kept: first * last >= 0 && free, sense: first * last };
}

/** The turn that brings another basis nearest to one (the orthogonal factor of their product), and how far it stays. */
function nearest(rows, others) {
  const product = rows[0].map((_, i) => rows[0].map((_, j) => sum(rows, (row, k) => row[i] * others[k][j])));
  const { values, left, right } = singular(product);
  const turn = product.map((_, j) => product.map((_, i) => sum(right, (column, k) => column[i] * left[k][j])));
  return { turn, away: Math.sqrt(2 * Math.max(0, 1 - values.at(-1))) };
}
