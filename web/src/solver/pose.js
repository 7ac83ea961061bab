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
const LEAST_COSINE = 1e-12;

/** @param {string} name */
export const isLength = (name) => LENGTHS.includes(name);

/** Names of the velocity's parts: the coordinates', but wx, wy, wz for a quaternion. @param {string[]} pose */
export const rateNames = (pose) =>
  pose.includes("qw") ? [...pose.filter((name) => !QUATERNION.includes(name)), "wx", "wy", "wz"] : pose;

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

/** The unit quaternion of a pose with one. @returns {number[]} its orientation as nine numbers */
export const turnOfPose = (model, pose) => fromQuaternion(part(model, pose, QUATERNION));

/** How far the platform is from a pose: lengths, and rotations times the model's length. @returns {number[]} */
export function poseError(model, placed, wanted) {
  const { turn, point } = platformOf(model, placed);
  const angles = toAngles(turn);
  const rows = [];
  model.pose.forEach((name, k) => {
    if (isLength(name)) rows.push(point[LENGTHS.indexOf(name)] - wanted[k]);
    else if (ANGLES.includes(name)) rows.push(model.length * nearestTurn(angles[ANGLES.indexOf(name)] - wanted[k]));
  });
  if (model.pose.includes("qw"))
    rows.push(...times(model.length, toVector(multiply(turn, transpose(turnOfPose(model, wanted))))));
  return rows;
}

/**
 * Rates of the pose per rate of each joint value, rows as `rateNames` names them.
 * @returns {number[][]} one row of n numbers for each
 */
export function poseRates(model, placed, twists) {
  const { turn, point } = platformOf(model, placed);
  const angles = model.pose.some((name) => ANGLES.includes(name)) ? toAngles(turn) : null;
  const rows = rateNames(model.pose).map(() => new Array(model.count).fill(0));
  const names = rateNames(model.pose);
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

/** A pose between two, straight in lengths and angles, one turn for a quaternion. @returns {(t: number) => number[]} */
export function between(model, start, end) {
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
