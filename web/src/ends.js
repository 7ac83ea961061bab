/** Ends of a slider: round numbers that always hold what it shows. */

const TURN = 2 * Math.PI;
const ROOM = 0.1; // of the slider goes beyond a value that made it longer
const ROUND = 20; // ends are whole multiples of a round number that is at most this share of the slider
const SLACK = 1e-9;

/** The largest of 1, 2 and 5 times a power of ten that is not above a positive number. */
export function roundBelow(value) {
  const power = 10 ** Math.floor(Math.log10(value) + SLACK);
  return power * (5 * power <= value * (1 + SLACK) ? 5 : 2 * power <= value * (1 + SLACK) ? 2 : 1);
}

/** An angle with as many whole turns as bring it into a range, or nearest to its middle. @param {number[]} ends */
export function unwound(value, [low, high]) {
  if (value >= low && value <= high) return value;
  return value - TURN * Math.round((value - (low + high) / 2) / TURN);
}

/** The very ends, or as far beyond them as a value needs, with some room. @param {number[]} ends @returns {number[]} */
export function holding(ends, value) {
  const [low, high] = ends;
  const slack = SLACK * (high - low);
  if (value >= low - slack && value <= high + slack) return ends;
  const room = ROOM * (high - low);
  const step = roundBelow((Math.max(high, value) - Math.min(low, value)) / ROUND);
  const clean = (count) => Number((step * count).toPrecision(12));
  return value < low
    ? [clean(Math.floor((value - room) / step)), high]
    : [low, clean(Math.ceil((value + room) / step))];
}

/** What a slider of the pose covers: what the scene says; the angles of a quaternion all that they can be. */
export function rangeOf(name, { scene, model }) {
  const index = model.pose.indexOf(name);
  if (index >= 0) return scene.poseRange[index];
  return name === "theta" ? [-Math.PI / 2, Math.PI / 2] : [-Math.PI, Math.PI];
}
