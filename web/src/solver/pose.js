/** The platform's pose: its coordinates, how far it is from a wanted one, and its rates. */

import { configurationAt } from "./configuration.js";
import {
  fromAngles,
  fromQuaternion,
  fromVector,
  multiply,
  nearestTurn,
  times,
  toAngles,
  toQuaternion,
  toVector,
  transpose,
} from "./rotation.js";

const LENGTHS = ["x", "y", "z"];
const ANGLES = ["phi", "theta", "psi"];
const QUATERNION = ["qw", "qx", "qy", "qz"];
const TURNS = ["wx", "wy", "wz"];
const LEAST_COSINE = 1e-12;
const UPRIGHT = 1e-9; // cosine of theta below which phi is rounding: loops close to so much

/** @param {string} name */
export const isLength = (name) => LENGTHS.includes(name);

/** Whether a pose tells phi, theta and psi. @param {string[]} pose */
export const hasAngles = (pose) => ANGLES.every((name) => pose.includes(name));

/**
 * Names of the velocity's parts: the coordinates', but wx, wy, wz for a pose that tells the whole orientation, as phi and
 * psi have no rates of their own where theta is a right angle. @param {string[]} pose
 */
export const rateNames = (pose) => (pose.includes("qw") || hasAngles(pose) ? [...pose.filter(isLength), ...TURNS] : pose);

/** @returns {number[]} the pose, in lengths and rad, as the scene names it */
export function poseOf(model, values) {
  const { turn, origin: point } = configurationAt(model, values).platform;
  const angles = toAngles(turn);
  const quaternion = model.pose.includes("qw") ? toQuaternion(turn) : [];
  return model.pose.map((name) =>
    isLength(name)
      ? point[LENGTHS.indexOf(name)]
      : ANGLES.includes(name)
        ? angles[ANGLES.indexOf(name)]
        : quaternion[QUATERNION.indexOf(name)],
  );
}

const part = (model, pose, names) => names.map((name) => pose[model.pose.indexOf(name)]);

/** The orientation that a pose tells, as nine numbers. @returns {number[]} */
export const turnOfPose = (model, pose) =>
  model.pose.includes("qw") ? fromQuaternion(part(model, pose, QUATERNION)) : fromAngles(...part(model, pose, ANGLES));

/** How far the platform is from a pose: lengths, and rotations times the model's length. @returns {number[]} */
export function poseError(model, at, wanted) {
  const { turn, origin: point } = at.platform;
  const whole = rateNames(model.pose) !== model.pose;
  const angles = toAngles(turn);
  const rows = [];
  model.pose.forEach((name, k) => {
    if (isLength(name)) rows.push(point[LENGTHS.indexOf(name)] - wanted[k]);
    else if (!whole) rows.push(model.length * nearestTurn(angles[ANGLES.indexOf(name)] - wanted[k]));
  });
  if (whole)
    rows.push(...times(model.length, toVector(multiply(turn, transpose(turnOfPose(model, wanted))))));
  return rows;
}

/** Rates of the pose per rate of each joint value, rows as names have it. @returns {ArrayLike<number>[]} rows of n numbers */
export function poseRates({ platform, moves }, names) {
  const [spins, velocities] = [moves.slice(0, 3), moves.slice(3)];
  const angles = names.some((name) => ANGLES.includes(name)) ? angleRates(platform.turn, spins) : null;
  return names.map((name) =>
    isLength(name)
      ? velocities[LENGTHS.indexOf(name)]
      : name[0] === "w"
        ? spins[TURNS.indexOf(name)]
        : angles[ANGLES.indexOf(name)],
  );
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
  if (!model.pose.includes("qw")) return (t) => start.map((value, k) => value + t * change[k]);
  const first = turnOfPose(model, start);
  const turn = toVector(multiply(turnOfPose(model, end), transpose(first)));
  return (t) => {
    const quaternion = toQuaternion(multiply(fromVector(times(t, turn)), first));
    return model.pose.map((name, k) =>
      QUATERNION.includes(name) ? quaternion[QUATERNION.indexOf(name)] : start[k] + t * change[k],
    );
  };
}

/** A pose as sliders show it: a quaternion as phi, theta, psi. @returns {{names: string[], values: number[]}} */
export function shownPose(model, pose) {
  if (!model.pose.includes("qw")) return { names: model.pose, values: pose };
  const kept = model.pose.flatMap((name, k) => (QUATERNION.includes(name) ? [] : [[name, pose[k]]]));
  const angles = toAngles(turnOfPose(model, pose));
  return { names: [...kept.map(([name]) => name), ...ANGLES], values: [...kept.map(([, value]) => value), ...angles] };
}

/** The pose of what sliders show. @param {number[]} shown @returns {number[]} */
export function poseOfShown(model, shown) {
  if (!model.pose.includes("qw")) return shown;
  const count = shown.length - 3;
  const quaternion = toQuaternion(fromAngles(...shown.slice(count)));
  const lengths = shown.slice(0, count);
  return model.pose.map((name) => (QUATERNION.includes(name) ? quaternion[QUATERNION.indexOf(name)] : lengths.shift()));
}
