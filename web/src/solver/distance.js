/**
 * How far the nearest singularity is, the orientation held: along rays, and from where they end by Newton's steps.
 *
 * What is found is a pose that is singular to about a thousandth of its distance; a nearer one that no ray meets may be
 * missed. Beyond a ray's end the mechanism cannot go on in its mode, whatever its measures say.
 */

import { dot } from "./leastsquares.js";
import { regularKinds } from "./motion.js";
import { nearAssembly } from "./newton.js";
import { isLength, poseOf } from "./pose.js";
import { measuresAt, passage } from "./rates.js";

const SHIFTS = [1e-4, 1e-6, 1e-8]; // for derivatives, of the model's length
const LONGEST = 0.1; // step, of the model's length
const LEAST = 1e-5; // step along a ray, of the model's length: where that is refused the ray ends
const ASIDE = 0.02; // of the model's length
const HALVES = 6; // of Newton's step that leads out of reach
const STEPS = 30;
const SETTLED = 1e-3; // of the distance: steps that are shorter end the search, and what is left is that little

const minus = (a, b) => a.map((value, k) => value - b[k]);

/** What vanishes: the parallel measure with its sign, which it changes; the others squared, for they fall to zero like a
 * root where two working modes meet and the reach ends. */
const VANISHES = {
  parallel: ({ measured, sense }) => sense * measured.parallel,
  serial: ({ measured }) => measured.serial ** 2,
  passive: ({ measured }) => measured.passive ** 2,
};

/** The nearest singularity that was found so far; `search` goes on, and who calls it may stop at any time. */
export class NearestSingular {
  /** In length units; infinite where none was found within the model's length, NaN where the pose has no lengths. */
  amount = Infinity;
  /** @type {"parallel"|"serial"|"passive"} */
  kind = "parallel";
  /** The pose that is nearly singular; null where none was found. @type {number[]|null} */
  pose = null;

  constructor(model, values) {
    const pose = poseOf(model, values);
    this.model = model;
    this.lengths = pose.map((_, k) => k).filter((k) => isLength(model.pose[k]));
    this.kinds = regularKinds(model);
    this.start = { values, pose, measured: measuresAt(model, values), sense: 1 };
    if (!this.lengths.length) this.amount = NaN;
  }

  /** Every portion, some solved poses long, so that a page can draw between them. */
  *search() {
    if (!this.lengths.length) return;
    for (const from of [this.start, this.aside()]) for (const kind of this.kinds) yield* this.descend(from, kind);
    for (const way of directions(this.lengths.length)) {
      const end = yield* this.ray(way);
      if (end) yield* this.descend(end.inner, end.kind);
    }
  }

  /** A place a little beside the start: from a pose of symmetry the steepest way may lead to where two legs end at once. */
  aside() {
    const { model, start, lengths } = this;
    const step = lengths.map((_, j) => 0.6 ** j);
    return reached(model, start, shifted(start.pose, lengths, step, ASIDE * model.length)) ?? start;
  }

  /** How far a pose is from where the search began, in the coordinates that are lengths. */
  away(pose) {
    return Math.hypot(...this.lengths.map((k) => pose[k] - this.start.pose[k]));
  }

  take(amount, kind, pose) {
    if (amount < this.amount && amount <= this.model.length)
      Object.assign(this, { amount, kind, pose: pose.slice() });
  }

  /** The kind of singularity that ends a ray, and a place some way before it; null where nothing nearer than that known does. */
  *ray(way) {
    const { model, start, lengths } = this;
    const end = Math.min(this.amount, model.length);
    let [last, inner, away, step] = [start, start, 0, LONGEST * model.length];
    while (away < end) {
      const next = Math.min(end, away + step);
      const pose = shifted(start.pose, lengths, way, next);
      const there = reached(model, last, pose);
      yield;
      if (there?.sense > 0) {
        if (next - this.away(inner.pose) > LONGEST * model.length) inner = last;
        [last, away, step] = [there, next, Math.min(2 * step, LONGEST * model.length)];
      } else if (step > LEAST * model.length) step /= 2;
      else {
        const kind = there ? "parallel" : this.least(last);
        this.take(next, kind, pose);
        return { inner, kind };
      }
    }
    return null;
  }

  /** The kind that is nearest to zero of those that end a mode's reach. */
  least({ measured }) {
    const kinds = this.kinds.filter((kind) => kind !== "parallel");
    return kinds.reduce((best, kind) => (measured[kind] < measured[best] ? kind : best), kinds[0] ?? "serial");
  }

  /** Newton's steps from a place to the nearest pose at which the measure of a kind vanishes. */
  *descend(from, kind) {
    const { model, start, lengths } = this;
    const origin = lengths.map((k) => start.pose[k]);
    const measure = VANISHES[kind];
    let at = from;
    for (let k = 0; k < STEPS; k++) {
      const value = measure(at);
      if (value === 0) return this.take(this.away(at.pose), kind, at.pose);
      const slope = [];
      for (const index of lengths) {
        slope.push(slopeBy(model, at, index, measure));
        yield;
      }
      const square = dot(slope, slope);
      if (!(square > 0)) return;
      const here = lengths.map((index) => at.pose[index]);
      const left = Math.abs(value) / Math.sqrt(square);
      const away = this.away(at.pose);
      const small = SETTLED * (away + left) + LEAST * model.length;
      if (left <= small) this.take(away + left, kind, at.pose);
      // the nearest pose to the origin at which the measure's tangent plane vanishes
      const share = (value + dot(slope, minus(origin, here))) / square;
      const step = minus(minus(origin, slope.map((item) => item * share)), here);
      const length = Math.hypot(...step);
      if (length <= small) return;
      at = moved(model, at, lengths, step, Math.min(1, (LONGEST * model.length) / length));
      if (!at) return;
    }
  }
}

/** Unit vectors along axes and diagonals. */
function directions(count) {
  const longer = (ways) => ways.flatMap((way) => [-1, 0, 1].map((item) => [...way, item]));
  const ways = Array.from({ length: count }).reduce(longer, [[]]);
  return ways.filter((way) => way.some(Boolean)).map((way) => way.map((item) => item / Math.hypot(...way)));
}

/** The mechanism a share of a step further, or less of it where that is out of reach; null where no part is. */
function moved(model, at, lengths, step, share) {
  for (let k = 0; k < HALVES; k++, share /= 2) {
    const there = reached(model, at, shifted(at.pose, lengths, step, share));
    if (there) return there;
  }
  return null;
}

/** A pose with its lengths changed by so much of a step. */
function shifted(pose, lengths, step, share) {
  const found = pose.slice();
  lengths.forEach((index, j) => (found[index] += share * step[j]));
  return found;
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
      reached(model, at, shifted(at.pose, [index], [1], amount)),
    );
    if (ahead || behind) return (measure(ahead ?? at) - measure(behind ?? at)) / (ahead && behind ? 2 * shift : shift);
  }
  return 0; // nearer to a border than that
}
