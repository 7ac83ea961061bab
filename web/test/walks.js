/** Random walks that end at stops: from there the way back must be free, and the reason that was said must be true. */

import { residual } from "../src/solver/closure.js";
import { NearestSingular } from "../src/solver/distance.js";
import { LEAST_STEP, inputsOf, toInputs, toPose } from "../src/solver/motion.js";
import { isLength, poseOf, poseOfShown, shownPose } from "../src/solver/pose.js";
import { measuresAt } from "../src/solver/rates.js";

const PUSHES = [1, 1e-2, 1e-4]; // shares of a refused way that are tried again, each from where the last one stopped
const ARRIVED = 1e-6; // of the model's length, or rad
const REGULAR = 0.02; // measures above it: a place where numbers are exact to ARRIVED
const LEAST = 0.05; // a singularity that is said is at least that near

/** Numbers between 0 and 1, the same ones for the same seed (mulberry32). */
export function random(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** The nearest singularity, searched to the end. */
export function nearestSingular(model, values) {
  const found = new NearestSingular(model, values);
  for (const _ of found.search());
  return found;
}

/** The two kinds of sliders: what they show, the size of their units, and how they move. */
const SIDES = {
  inputs: {
    shown: inputsOf,
    units: (model) => model.inputs.map(({ kind }) => (kind === "length" ? model.length : 1)),
    move: toInputs,
  },
  pose: {
    shown: (model, values) => shownPose(model, poseOf(model, values)).values,
    units: (model) => {
      const { names } = shownPose(model, poseOf(model, model.home));
      return names.map((name) => (isLength(name) ? model.length : 1));
    },
    move: (model, values, target) => toPose(model, values, poseOfShown(model, target)),
  },
};

const regular = (model, values) => {
  const { parallel, serial, passive } = measuresAt(model, values);
  return Math.min(parallel, serial, passive) > REGULAR;
};

/** How far two shown lists are from each other, without dimensions and whole turns. */
const apart = (side, model, a, b) =>
  Math.max(
    ...side.units(model).map((unit, k) => {
      const away = (a[k] - b[k]) / unit;
      return Math.abs(unit === 1 ? away - 2 * Math.PI * Math.round(away / (2 * Math.PI)) : away);
    }),
  );

/**
 * Walks from home by one slider or all of them at once, pushes on where it is stopped, and comes back.
 * @param {import("../src/solver/configuration.js").Model} model
 * @param {{moves: number, seed: number}} options
 * @returns {{moves: number, stops: Record<string, number>, faults: string[]}} stops: how many, by what stopped it
 */
export function walked(model, { moves, seed }) {
  const draw = random(seed);
  const found = { moves: 0, stops: {}, faults: [] };
  let values = model.home;
  for (let k = 0; k < moves; k++) {
    const name = draw() < 0.5 ? "inputs" : "pose";
    const side = SIDES[name];
    const start = side.shown(model, values);
    const units = side.units(model);
    const size = 10 ** (-1.7 + 2 * draw());
    const only = draw() < 0.7 ? Math.floor(draw() * units.length) : -1;
    const way = units.map((unit, j) => (only < 0 || j === only ? size * unit * (2 * draw() - 1) : 0));
    const target = start.map((value, j) => value + way[j]);
    const there = side.move(model, values, target);
    found.moves++;
    const said = () => `move ${k} of ${seed}, ${name} ${start} to ${target}`;
    const fault = (text) => found.faults.push(`${said()}: ${text}`);
    if (!(residual(model, there.values) < 1e-9 * model.length)) fault("the loops are open");
    if (there.status === "moved") {
      values = there.values;
      continue;
    }
    const { kind, text } = there.reason;
    const cause = kind === "singular" ? /parallel|serial|stretched/.exec(text)[0] : kind;
    found.stops[cause] = (found.stops[cause] ?? 0) + 1;
    let at = there.values;
    for (const share of PUSHES) {
      at = side.move(model, at, side.shown(model, at).map((value, j) => value + share * way[j])).values;
      found.moves++;
    }
    for (const wrong of untrue(model, at, there.reason)) fault(`${text}, but ${wrong}`);
    const back = side.move(model, at, start);
    found.moves++;
    // the start stood on an end, as near as rounding lets it: the least step before it is refused
    const onBound = ["stroke", "limit"].includes(back.reason?.kind) && back.share >= 1 - 2 * LEAST_STEP;
    const exact = regular(model, values) && !onBound;
    if (exact && back.status !== "moved") fault(`no way back, stopped after ${back.share}: ${back.reason.text}`);
    else if (exact) {
      for (const other of Object.values(SIDES)) {
        const away = apart(other, model, other.shown(model, back.values), other.shown(model, values));
        if (away > ARRIVED) fault(`came back elsewhere, ${away} away`);
      }
    } else if (back.share < 0.99 && apart(side, model, side.shown(model, at), start) > ARRIVED)
      fault(`no way back to a stop, only ${back.share} of it: ${back.reason.text}`);
    const bounded = kind === "stroke" || kind === "limit"; // where two of these meet, no single slider may lead away
    for (const other of Object.keys(SIDES)) if (!bounded && shut(model, at, SIDES[other])) fault(`${other} move no way from there`);
    const next = draw();
    values = next < 0.3 ? at : next < 0.8 ? back.values : model.home;
  }
  return found;
}

/** Whether no slider of a side can be moved by any amount worth while. */
function shut(model, values, side) {
  const start = side.shown(model, values);
  return side.units(model).every((unit, k) =>
    [0.01, -0.01].every((share) => {
      const target = start.map((value, j) => value + (j === k ? share * unit : 0));
      return side.move(model, values, target).share < 0.01;
    }),
  );
}

/** What of a reason is not so where it was said. @returns {string[]} */
function untrue(model, values, { kind, text, joint, amount }) {
  const { parallel, serial, passive } = measuresAt(model, values);
  if (kind === "singular" && text.startsWith("parallel") && parallel > LEAST) return [`the measure is ${parallel}`];
  if (kind === "singular" && text.startsWith("serial") && serial > LEAST) return [`the measure is ${serial}`];
  if (kind === "singular" && text.includes("stretched") && passive > LEAST) return [`the measure is ${passive}`];
  if (kind === "stroke") {
    const away = inputsOf(model, values)[model.inputs.findIndex(({ name }) => name === joint)] - amount;
    if (Math.abs(away) > 1e-3 * model.length) return [`it is ${away} away from that`];
  }
  if (kind === "gap" && !(amount > 0)) return ["no loop stays open"];
  if (kind === "gap" && Math.min(parallel, serial, passive) > LEAST)
    return [`the measures are ${parallel}, ${serial}, ${passive}`];
  return [];
}
