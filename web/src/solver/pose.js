/** The platform's pose: its coordinates, how far it is from a wanted one, and its rates. */

import {
  add,
  apply,
  cross,
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

/** @returns {{turn: number[], point: number[]}} orientation of the platform, and its point */
export function platformOf(model, placed) {
  const { turn, origin } = placed[model.platform];
  return { turn, point: add(origin, apply(turn, model.point)) };
}

/** @returns {number[]} the pose, in lengths and rad, as the scene names it */
export function poseOf(model, placed) {
  const { turn, point } = platformOf(model, placed);
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
export function poseError(model, placed, wanted) {
  const { turn, point } = platformOf(model, placed);
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

/**
 * Rates of the pose per rate of each joint value, rows as names have it: by default those of `rateNames`.
 * @returns {number[][]} one row of n numbers for each
 */
export function poseRates(model, placed, twists, names = rateNames(model.pose)) {
  const { turn, point } = platformOf(model, placed);
  const angles = names.some((name) => ANGLES.includes(name)) ? toAngles(turn) : null;
  const rows = names.map(() => new Array(model.count).fill(0));
  for (const [k, sense] of model.pathToPlatform) {
    const { first, freedoms } = model.joints[k];
    for (let column = first; column < first + freedoms; column++) {
      const { angular, linear } = twists[column];
      const velocity = add(linear, cross(angular, point));
      const turned = angles && angleRates(angles, angular);
      names.forEach((name, row) => {
        const value = isLength(name)
          ? velocity[LENGTHS.indexOf(name)]
          : name[0] === "w"
            ? angular["xyz".indexOf(name[1])]
            : turned[ANGLES.indexOf(name)];
        rows[row][column] = sense * value;
      });
    }
  }
  return rows;
}

function angleRates([phi, theta], [wx, wy, wz]) {
  const psi = (Math.cos(phi) * wx + Math.sin(phi) * wy) / Math.max(Math.cos(theta), LEAST_COSINE);
  return [wz + Math.sin(theta) * psi, Math.cos(phi) * wy - Math.sin(phi) * wx, psi];
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
