/**
 * How far the nearest singularity is, the orientation held: along rays, and from where they meet one by Newton's steps.
 *
 * What is found is a singular pose, so its distance is true; a nearer one that no ray meets may be missed.
 */

import { frames } from "./frames.js";
import { nearAssembly } from "./newton.js";
import { isLength, poseOf } from "./pose.js";
import { measuresAt, passage } from "./rates.js";

const SHIFTS = [1e-4, 1e-6, 1e-8]; // for derivatives, of the model's length
const RAY = 0.1; // step along a ray, of the model's length
const LONGEST = 0.1; // step, of the model's length
const HALVES = 6; // of a step that leads out of reach
const STEPS = 30;
const SETTLED = 1e-3; // of the distance: steps that are shorter end the search, and what is left is that little
const NOTHING = 1e-5; // of the model's length: a distance that is none

const dot = (a, b) => a.reduce((total, value, k) => total + value * b[k], 0);
const minus = (a, b) => a.map((value, k) => value - b[k]);

/** What vanishes: the parallel measure with its sign, which it changes; the serial one squared, for it falls to zero
 * like a root where two working modes meet and the reach ends. */
const VANISHES = {
  parallel: ({ measured, sense }) => sense * measured.parallel,
  serial: ({ measured }) => measured.serial ** 2,
};

/** The nearest singularity that was found so far; `search` goes on, and who calls it may stop at any time. */
export class NearestSingular {
  /** In length units; infinite where none was found within the model's length, NaN where the pose has no lengths. */
  amount = Infinity;
  /** @type {"parallel"|"serial"} */
  kind = "parallel";

  constructor(model, values) {
    const pose = poseOf(model, frames(model, values));
    this.model = model;
    this.lengths = pose.map((_, k) => k).filter((k) => isLength(model.pose[k]));
    this.start = { values, pose, measured: measuresAt(model, values), sense: 1 };
    if (!this.lengths.length) this.amount = NaN;
  }

  /** Every portion, some solved poses long, so that a page can draw between them. */
  *search() {
    if (!this.lengths.length) return;
    yield* this.look(this.start, "parallel");
    yield* this.look(this.start, "serial");
    for (const way of directions(this.lengths.length)) {
      const met = yield* ray(this.model, this.start, this.lengths, way, Math.min(this.amount, this.model.length));
      if (met) yield* this.look(met.last, met.kind);
    }
  }

  *look(from, kind) {
    const amount = this.start.measured[kind] === 0 ? 0 : yield* amountTo(this.model, this.start, from, this.lengths, kind);
    if (amount < this.amount && amount <= this.model.length) [this.amount, this.kind] = [amount, kind];
  }
}

/** The whole search at once. @returns {NearestSingular} */
export function nearestSingular(model, values) {
  const found = new NearestSingular(model, values);
  const search = found.search();
  while (!search.next().done);
  return found;
}

/** Unit vectors along axes and diagonals. */
function directions(count) {
  const signs = Array.from({ length: count }).reduce((all) => all.flatMap((way) => [-1, 0, 1].map((item) => [...way, item])), [[]]);
  return signs.filter((way) => way.some(Boolean)).map((way) => way.map((item) => item / Math.hypot(...way)));
}

/** The last place on a ray before its steps meet a singularity, and of what kind; null where they meet none. */
function* ray(model, start, lengths, way, end) {
  let last = start;
  for (let away = RAY * model.length; away < end + RAY * model.length; away += RAY * model.length) {
    const pose = start.pose.slice();
    lengths.forEach((index, j) => (pose[index] += Math.min(away, end) * way[j]));
    const there = reached(model, last, pose);
    yield;
    if (!there) return { last, kind: "serial" };
    if (there.sense < 0) return { last, kind: "parallel" };
    last = there;
  }
  return null;
}

/** Distance from the start of a pose at which the measure of a kind vanishes, the nearest one that steps come by. */
function* amountTo(model, start, from, lengths, kind) {
  const only = (pose) => lengths.map((k) => pose[k]);
  const origin = only(start.pose);
  let at = from;
  let best = Infinity;
  for (let k = 0; k < STEPS; k++) {
    const slope = [];
    for (const index of lengths) {
      slope.push(slopeBy(model, at, index, VANISHES[kind]));
      yield;
    }
    const square = dot(slope, slope);
    if (!(square > 0)) break;
    const value = VANISHES[kind](at);
    const here = only(at.pose);
    const left = Math.abs(value) / Math.sqrt(square);
    const away = Math.hypot(...minus(here, origin));
    const small = SETTLED * (away + left) + NOTHING * model.length;
    if (left <= small) best = Math.min(best, away + left);
    // the nearest pose to the origin at which the measure's tangent plane vanishes
    const share = (value + dot(slope, minus(origin, here))) / square;
    const step = minus(minus(origin, slope.map((item) => item * share)), here);
    const length = Math.hypot(...step);
    if (length <= small) break;
    const next = moved(model, at, lengths, step, Math.min(1, (LONGEST * model.length) / length));
    if (!next) break;
    at = next;
  }
  return best;
}

/** The mechanism a share of a step further, or less of it where that is out of reach; null where no part is. */
function moved(model, at, lengths, step, share) {
  for (let k = 0; k < HALVES; k++, share /= 2) {
    const pose = at.pose.slice();
    lengths.forEach((index, j) => (pose[index] += share * step[j]));
    const there = reached(model, at, pose);
    if (there) return there;
  }
  return null;
}

/** The assembly at a pose near by, and whether its parallel measure has the sign of the start's. */
function reached(model, at, pose) {
  const values = nearAssembly(model, at.values, [], pose);
  if (!values) return null;
  const measured = measuresAt(model, values);
  return { values, pose, measured, sense: at.sense * (passage(at.measured, measured, "parallel").sense || 1) };
}

/** Derivative of a measure by one of the pose's lengths, from both sides where both are in reach. */
function slopeBy(model, at, index, measure) {
  for (const shift of SHIFTS.map((part) => part * model.length)) {
    const [ahead, behind] = [shift, -shift].map((amount) =>
      reached(model, at, at.pose.map((value, k) => (k === index ? value + amount : value))),
    );
    if (ahead || behind) return (measure(ahead ?? at) - measure(behind ?? at)) / (ahead && behind ? 2 * shift : shift);
  }
  return 0; // nearer to a border than that
}
