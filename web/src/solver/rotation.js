/**
 * Rotations: 3 x 3 matrices as nine numbers, row by row; vectors as three.
 *
 * The conventions are those of `assur.numerics.rotations`: angles in rad, R = Rz(phi) Ry(theta) Rx(psi),
 * quaternions with the scalar first.
 */

/** @typedef {number[]} Vector three numbers */
/** @typedef {number[]} Matrix nine numbers, row by row */

const NEARLY_UPRIGHT = 1e-4; // cosine of theta
const SMALL = 1e-2;

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const times = (s, a) => [s * a[0], s * a[1], s * a[2]];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const norm = (a) => Math.hypot(a[0], a[1], a[2]);

/** @param {Matrix} a @param {Matrix} b @returns {Matrix} a b */
export function multiply(a, b) {
  const c = new Array(9);
  for (let i = 0; i < 9; i += 3)
    for (let j = 0; j < 3; j++) c[i + j] = a[i] * b[j] + a[i + 1] * b[j + 3] + a[i + 2] * b[j + 6];
  return c;
}

export const transpose = (a) => [a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]];

/** @param {Matrix} a @param {Vector} v @returns {Vector} a v */
export const apply = (a, v) => [
  a[0] * v[0] + a[1] * v[1] + a[2] * v[2],
  a[3] * v[0] + a[4] * v[1] + a[5] * v[2],
  a[6] * v[0] + a[7] * v[1] + a[8] * v[2],
];

/** Where a point of a link is, in the base frame. */
export const placed = ({ turn, origin }, at) => add(origin, apply(turn, at));

/** I + s K + t K K, with K the cross product matrix of v. */
function series(v, s, t) {
  const [x, y, z] = v;
  return [
    1 - t * (y * y + z * z), t * x * y - s * z, t * x * z + s * y,
    t * x * y + s * z, 1 - t * (x * x + z * z), t * y * z - s * x,
    t * x * z - s * y, t * y * z + s * x, 1 - t * (x * x + y * y),
  ];
}

/** sin(a / 2) / a, (1 - cos a) / a^2 and (a - sin a) / a^3, exact at 0. */
function coefficients(a) {
  const q = a * a;
  if (a < SMALL) return [0.5 - q / 48 + (q * q) / 3840, 0.5 - q / 24 + (q * q) / 720, 1 / 6 - q / 120 + (q * q) / 5040];
  const half = Math.sin(a / 2);
  return [half / a, (2 * half ** 2) / q, (a - Math.sin(a)) / (q * a)];
}

/** @param {Vector} v a rotation vector @returns {number[]} its unit quaternion, scalar first */
export function quaternionOf(v) {
  const angle = norm(v);
  return [Math.cos(angle / 2), ...times(coefficients(angle)[0], v)];
}

/** @param {Vector} v a rotation vector @returns {Matrix} */
export const fromVector = (v) => fromQuaternion(quaternionOf(v));

/** What turns rates of a rotation vector into the angular velocity. @returns {Matrix} */
export function leftJacobian(v) {
  const [, second, third] = coefficients(norm(v));
  return series(v, second, third);
}

/** What turns the angular velocity into rates of a rotation vector; at whole turns it is large. @returns {Matrix} */
export function vectorRates(v) {
  const a = norm(v);
  return series(v, -0.5, a < SMALL ? 1 / 12 + (a * a) / 720 : (1 - a / 2 / Math.tan(a / 2)) / (a * a));
}

/** The rotation vector, at most pi long; it vanishes at the identity only. @param {Matrix} r @returns {Vector} */
export function toVector(r) {
  const [cosine, ...axis] = toQuaternion(r);
  const sine = norm(axis); // of half the angle
  return times(sine > 0 ? (2 * Math.atan2(sine, cosine)) / sine : 2, axis);
}

/** The rotation vector that brings one orientation to another. @param {Matrix} from @param {Matrix} to @returns {Vector} */
export const turnBetween = (from, to) => toVector(multiply(to, transpose(from)));

/** @param {number[]} q scalar first @returns {Matrix} */
export function fromQuaternion(q) {
  const size = Math.hypot(...q);
  const [w, x, y, z] = q.map((part) => part / size);
  return series([x, y, z], 2 * w, 2);
}

/** The unit quaternion, its scalar first and not negative. @param {Matrix} r @returns {number[]} */
export function toQuaternion(r) {
  const [x, y, z] = [r[7] - r[5], r[2] - r[6], r[3] - r[1]];
  const [xy, xz, yz] = [r[1] + r[3], r[2] + r[6], r[5] + r[7]];
  const outer = [
    [1 + r[0] + r[4] + r[8], x, y, z],
    [x, 1 + r[0] - r[4] - r[8], xy, xz],
    [y, xy, 1 - r[0] + r[4] - r[8], yz],
    [z, xz, yz, 1 - r[0] - r[4] + r[8]],
  ]; // 4 q q, of which the row of the largest part is taken
  const row = outer.reduce((best, other, k) => (other[k] > best[outer.indexOf(best)] ? other : best));
  const size = Math.hypot(...row) * (row[0] < 0 ? -1 : 1);
  return row.map((part) => part / size);
}

/** @param {Matrix} r @returns {[number, number, number]} phi, theta, psi */
export function toAngles(r) {
  const across = Math.hypot(r[0], r[3]);
  const theta = Math.atan2(-r[6], across);
  if (across >= NEARLY_UPRIGHT) return [Math.atan2(r[3], r[0]), theta, Math.atan2(r[7], r[8])];
  // near a right angle rounding decides phi; what is left after it tells psi as well as anywhere
  const phi = across <= 1e-15 ? 0 : Math.atan2(r[3], r[0]);
  const [cosine, sine] = [Math.cos(phi), Math.sin(phi)];
  return [phi, theta, Math.atan2(sine * r[2] - cosine * r[5], cosine * r[4] - sine * r[1])];
}

/** @returns {Matrix} */
export function fromAngles(phi, theta, psi) {
  const about = (axis, angle) => series(axis, Math.sin(angle), 2 * Math.sin(angle / 2) ** 2);
  return multiply(multiply(about([0, 0, 1], phi), about([0, 1, 0], theta)), about([1, 0, 0], psi));
}

/** An angle within half a turn of 0. */
export const nearestTurn = (angle) => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
