/** What must be in the picture so that an object is: its furthest vertices in many directions. */

import { Vector3 } from "three";

/** Ways to all sides, some 15 degrees apart from each other. */
const STEPS = [-2, -1, 0, 1, 2];
const DIRECTIONS = STEPS.flatMap((x) => STEPS.flatMap((y) => STEPS.map((z) => new Vector3(x, y, z)))).filter(
  ({ x, y, z }) => [x, y, z].some((part) => Math.abs(part) === 2),
);

const FEW = 500; // vertices that are all taken: of so few, each may be a corner

/** Those of a geometry in its own frame; found once. @returns {Vector3[]} */
function furthest(geometry) {
  if (!geometry.userData.furthest) {
    const { array, count } = geometry.getAttribute("position");
    const all = Array.from({ length: Math.min(count, FEW) }, (_, k) => k);
    const found = new Set(count > FEW ? DIRECTIONS.map((way) => furthestOf(array, count, way)) : all);
    geometry.userData.furthest = [...found].map((k) => new Vector3().fromArray(array, 3 * k));
  }
  return geometry.userData.furthest;
}

/** Which vertex lies furthest in a direction. */
function furthestOf(array, count, { x, y, z }) {
  let [best, most] = [0, -Infinity];
  for (let k = 0; k < count; k++) {
    const far = x * array[3 * k] + y * array[3 * k + 1] + z * array[3 * k + 2];
    if (far > most) [best, most] = [k, far];
  }
  return best;
}

/** The points of all that is visible of an object, where it stands now.
 * @param {boolean} moving whether only of what moves
 * @returns {Vector3[]} */
export function outline(object, moving = false) {
  object.updateWorldMatrix(true, true);
  const found = [];
  object.traverseVisible(({ geometry, matrixWorld, userData }) => {
    if (!geometry || (moving && userData.still)) return;
    for (const point of furthest(geometry)) found.push(point.clone().applyMatrix4(matrixWorld));
  });
  return found;
}
