/** The platform's pose: its coordinates, how far it is from a wanted one, and its rates. */

import { configurationAt } from "./configuration.js";
import { fromAngles, fromQuaternion, fromVector, toAngles, toQuaternion } from "./rotation.js";
import { multiply, nearestTurn, times, turnBetween } from "./rotation.js";

const LENGTHS = ["x", "y", "z"];
const ANGLES = ["phi", "theta", "psi"];
const QUATERNION = ["qw", "qx", "qy", "qz"];
const TURNS = ["wx", "wy", "wz"];
const LEAST_COSINE = 1e-12;
const UPRIGHT = 1e-9; // cosine of theta below which phi is rounding: loops close to so much

const NAMES = [...LENGTHS, ...ANGLES, ...QUATERNION];
const RATES = [...LENGTHS, ...ANGLES, ...TURNS];

export const isLength = (name) => LENGTHS.includes(name);

/** Whether a pose tells phi, theta and psi. @param {string[]} pose */
export const hasAngles = (pose) => ANGLES.every((name) => pose.includes(name));

const hasQuaternion = (pose) => pose.includes("qw");

/**
 * Names of the velocity's parts: the coordinates', but wx, wy, wz for a pose that tells the whole orientation, as phi and
 * psi have no rates of their own where theta is a right angle. @param {string[]} pose
 */
export const rateNames = (pose) => (hasQuaternion(pose) || hasAngles(pose) ? [...pose.filter(isLength), ...TURNS] : pose);

/** @returns {number[]} the pose, in lengths and rad, as the scene names it */
export const poseOf = (model, values) => poseAt(model, configurationAt(model, values));

function poseAt(model, { platform: { turn, origin } }) {
  const numbers = [...origin, ...toAngles(turn), ...toQuaternion(turn)];
  return model.pose.map((name) => numbers[NAMES.indexOf(name)]);
}

const part = (model, pose, names) => names.map((name) => pose[model.pose.indexOf(name)]);

/** The orientation that a pose tells, as nine numbers. @returns {number[]} */
export const turnOfPose = (model, pose) =>
  hasQuaternion(model.pose) ? fromQuaternion(part(model, pose, QUATERNION)) : fromAngles(...part(model, pose, ANGLES));

/** How far the platform is from a pose: lengths, and rotations times the model's length. @returns {number[]} */
export function poseError(model, at, wanted) {
  const { pose, length } = model;
  const change = poseAt(model, at).map((value, k) => value - wanted[k]);
  if (rateNames(pose) === pose) return change.map((value, k) => (isLength(pose[k]) ? value : length * nearestTurn(value)));
  const turn = turnBetween(turnOfPose(model, wanted), at.platform.turn);
  return [...change.filter((_, k) => isLength(pose[k])), ...times(length, turn)];
}

/** Rates of the pose per scaled rate of each joint value, both without dimensions. @returns {ArrayLike<number>[]} */
export function poseRates({ pose, scale, length }, { platform, moves }, names = rateNames(pose)) {
  const [spins, velocities] = [moves.slice(0, 3), moves.slice(3)];
  const rows = [...velocities, ...angleRates(platform.turn, spins), ...spins];
  const scaled = (name) => (value, k) => (value * scale[k]) / (isLength(name) ? length : 1);
  return names.map((name) => rows[RATES.indexOf(name)].map(scaled(name)));
}

/** Rates of phi, theta and psi of angular velocities, each a row. */
function angleRates(turn, [wx, wy, wz]) {
  const [phi, theta] = toAngles(turn);
  const [cosine, sine] = [Math.cos(phi), Math.sin(phi)];
  const psi = wx.map((value, k) => (cosine * value + sine * wy[k]) / Math.max(Math.cos(theta), LEAST_COSINE));
  return [
    wz.map((value, k) => value + Math.sin(theta) * psi[k]),
    wy.map((value, k) => cosine * value - sine * wx[k]),
    psi,
  ];
}

/** The pose with phi that of another one, where theta is a right angle and only psi -+ phi counts. */
function turnedAlike(model, pose, other) {
  if (!hasAngles(model.pose)) return pose;
  const [phi, theta, psi] = ANGLES.map((name) => model.pose.indexOf(name));
  if (Math.abs(Math.cos(pose[theta])) > UPRIGHT) return pose;
  const found = pose.slice();
  found[phi] = other[phi];
  found[psi] += Math.sign(pose[theta]) * (other[phi] - pose[phi]);
  return found;
}

/** A pose between two, straight in lengths and angles, one turn for a quaternion. @returns {(t: number) => number[]} */
export function between(model, from, to) {
  const [start, end] = [turnedAlike(model, from, to), turnedAlike(model, to, from)];
  const change = model.pose.map((name, k) =>
    ANGLES.includes(name) ? nearestTurn(end[k] - start[k]) : end[k] - start[k],
  );
  const place = (t) => start.map((value, k) => value + t * change[k]);
  if (!hasQuaternion(model.pose)) return place;
  const first = turnOfPose(model, start);
  const turn = turnBetween(first, turnOfPose(model, end));
  return (t) => withQuaternion(model, place(t), multiply(fromVector(times(t, turn)), first));
}

/** A pose whose quaternion is that of an orientation. */
function withQuaternion(model, pose, turn) {
  const quaternion = toQuaternion(turn);
  return model.pose.map((name, k) => (isLength(name) ? pose[k] : quaternion[QUATERNION.indexOf(name)]));
}

/** A pose as sliders show it: a quaternion as phi, theta, psi. @returns {{names: string[], values: number[]}} */
export function shownPose(model, pose) {
  if (!hasQuaternion(model.pose)) return { names: model.pose, values: pose };
  const lengths = model.pose.filter(isLength);
  const angles = toAngles(turnOfPose(model, pose));
  return { names: [...lengths, ...ANGLES], values: [...part(model, pose, lengths), ...angles] };
}

/** The pose of what sliders show. @param {number[]} shown @returns {number[]} */
export function poseOfShown(model, shown) {
  if (!hasQuaternion(model.pose)) return shown;
  const lengths = shown.slice(0, -3);
  const pose = model.pose.map((name) => (isLength(name) ? lengths.shift() : 0));
  return withQuaternion(model, pose, fromAngles(...shown.slice(-3)));
}
