/**
 * Moving from where the mechanism stands to wanted inputs or a wanted pose, its mode kept.
 *
 * A step is taken where Newton's corrections shrink at once, no joint moves far and no singularity that would change
 * the mode can lie on it, be it passed once or twice; else it is halved. Where even a tiny step fails the motion stops,
 * and a reason says why.
 */

import { largestGap } from "./closure.js";
import { once, resize } from "./configuration.js";
import { limitsOf } from "./limits.js";
import { closestApproach, nearAssembly } from "./newton.js";
import { between, poseOf } from "./pose.js";
import { looseInput, looseJoint, measuresAt, passage } from "./rates.js";

/** Of the way that is done: no step is shorter, so a motion may stop that far before an end. */
export const LEAST_STEP = 1 / 8192;
const FIRST_STEP = 2 ** -24; // of the way: a start near a singularity is left in steps as small as its distance
const NEAR = 0.08; // a step as small as the least one ends that near to a singularity
const ALMOST = 1e-9;
const NOISE = 1e-12; // of the model's length: more than Newton's steps move a joint that stands still
const FURTHEST = 0.3; // that a joint value goes in one step, in rad or of the model's length
const AIM = 0.9; // share of that which the next step is meant to go
const FLOOR = 1e-8; // a measure below this may be on either side of 0
const NEAREST = 1e-4; // no step goes nearer to a singularity than that, where rounding would hide the way back

/** @typedef {{kind: "stroke"|"gap"|"singular"|"limit", text: string, joint: string, amount: number}} Reason
 * @typedef {{values: number[], status: "moved"|"stopped", reason: Reason|null, share: number,
 * crossed: boolean, turned: boolean}} Moved share: of the way; crossed: a parallel singularity may have been passed, as
 * was asked for; turned: a serial one may have been, so that another working mode begins */

/** The joint that a reason speaks of: of that name, or that an input drives; null where it names none. */
export function blamed(model, reason) {
  const index = model.inputs.find(({ name }) => name === reason?.joint)?.index;
  const drives = ({ first, freedoms }) => index >= first && index < first + freedoms;
  return model.joints.find((item) => item.name === reason?.joint) ?? model.joints.find(drives) ?? null;
}

/** Printed values of the inputs, lengths and rad. @returns {number[]} */
export const inputsOf = (model, values) => model.inputs.map((item) => item.sign * values[item.index] + item.offset);

/** From joint values of an assembly to printed inputs, lengths and rad, the assembly mode kept. @returns {Moved} */
export function toInputs(model, values, target, options) {
  const held = model.inputs.map(({ index }) => index);
  const end = model.inputs.map(({ sign, offset }, k) => (target[k] - offset) / sign);
  const place = (current, t) => {
    const moved = current.slice();
    held.forEach((index, k) => (moved[index] = values[index] + t * (end[k] - values[index])));
    return moved;
  };
  const attempt = (current, t) => nearAssembly(model, place(current, t), held, null);
  const ask = (current) => closestApproach(model, place(current, 1), held, null);
  return followed(model, values, { side: "inputs", attempt, ask }, options);
}

/** To a pose, lengths and rad, the working mode kept; `through` parallel singularities only if so asked, for no drive
 * could do that. @returns {Moved} */
export function toPose(model, values, target, options) {
  const way = between(model, poseOf(model, values), target);
  const attempt = (current, t) => nearAssembly(model, current, [], way(t));
  const ask = (current) => closestApproach(model, current, [], target, 100);
  return followed(model, values, { side: "pose", attempt, ask }, options);
}

/** To other dimensions, those of the sliders in lengths and rad, the inputs held, the assembly mode kept. @returns {Moved} */
export function toSizes(model, values, target, options) {
  const [start, held] = [model.sizes, model.inputs.map(({ index }) => index)];
  const sized = (solve, t) => (resize(model, start.map((value, k) => value + t * (target[k] - value))), solve());
  const attempt = (current, t) => sized(() => nearAssembly(model, current, held, null), t);
  const ask = (current) => sized(() => closestApproach(model, current, held, null), 1);
  const found = followed(model, values, { side: "inputs", attempt, ask }, options);
  return sized(() => found, found.share);
}

/** `attempt` is an assembly at a share of the way, `ask` what comes closest to its end. */
function followed(model, start, { side, attempt, ask }, { limits = true, through = false } = {}) {
  const guard = limits ? guardsOf(model, start) : [];
  const borders = { parallel: !through, serial: side === "pose", passive: true };
  const forbidden = regularKinds(model).filter((kind) => borders[kind]);
  const serial = side === "inputs" && regularKinds(model).includes("serial");
  let [values, share, step, reason, crossed, turned] = [wrapped(model, start), 0, 1, null, false, false];
  let here = measuresAt(model, values);
  while (share < 1) {
    const next = Math.min(1, share + step);
    const found = attempt(values, next);
    const long = found && longest(model, values, found);
    const far = long > FURTHEST;
    const limit = found && !far && guard.find((item) => item.margin(found) < -item.slack);
    const there = found && !far && !limit && measuresAt(model, found);
    const lost = there && forbidden.find((kind) => passed(here, there, kind));
    if (!there || lost) {
      reason = limit ? limit.reason : { passed: lost || null };
      const refused = next - share;
      if (refused <= LEAST_STEP * Math.max(share, FIRST_STEP)) break;
      step = refused / (share > 0 ? 2 : 4);
    } else {
      crossed ||= through && passed(here, there, "parallel");
      turned ||= serial && passed(here, there, "serial");
      [values, share] = [wrapped(model, found), next];
      here = values === found ? there : measuresAt(model, values);
      [step, reason] = [step * Math.min(2, (AIM * FURTHEST) / long), null];
    }
  }
  if (share >= 1) return { values, status: "moved", reason: null, share, crossed, turned };
  if (!reason.kind) reason = why(model, values, here, reason.passed, ask, side);
  return { values, status: "stopped", reason, share, crossed, turned };
}

/** How far the joint that moves most goes, without dimensions. */
const longest = (model, from, to) =>
  to.reduce((most, value, k) => Math.max(most, Math.abs(value - from[k]) / model.scale[k]), 0);

/** The singularities that change a mode: those that home does not have, as one that has them has them everywhere. */
export const regularKinds = once((model) => {
  const home = measuresAt(model, model.home);
  return ["parallel", "serial", "passive"].filter((kind) => home[kind] > FLOOR);
});

/** Whether a singularity may lie between two assemblies, or at the second one, or too near to it. */
const passed = (here, there, kind) =>
  there[kind] < FLOOR ||
  (there[kind] < NEAREST && there[kind] <= here[kind]) ||
  !passage(here, there, kind).kept;

/** Why no small step succeeds. @returns {Reason} */
function why(model, values, measured, crossed, ask, side) {
  const parallel = crossed === "parallel" || (side === "inputs" && measured.parallel < NEAR);
  const held = "parallel singularity: the inputs no longer hold the platform";
  const singular = (text, joint, amount) => ({ kind: "singular", text, joint, amount });
  if (parallel && side === "pose") return singular(held, "", 0);
  const { amount, joint } = largestGap(model, ask(values));
  const open = amount > ALMOST * model.length ? `open by ${said(amount)} ${model.unit}` : "";
  if (parallel && !open) return singular(held, "", amount);
  if (parallel) return singular(`${held} (beyond it the loop of ${joint} stays ${open})`, joint, amount);
  if (open) return { kind: "gap", text: `out of reach: the loop of ${joint} would stay ${open}`, joint, amount };
  const passive = measured.passive < measured.serial;
  const { name } = passive ? looseJoint(model, values) : model.inputs[looseInput(measured)];
  if (passive) return singular(`the leg of ${name} is stretched or folded and cannot go on`, name, amount);
  return singular(`serial singularity: the leg of ${name} cannot follow in this working mode`, name, amount);
}

/** A number as a person reads it, three figures. */
const said = (value) => (value === 0 ? "0" : String(Number(value.toPrecision(value >= 1000 ? 4 : 3))));

/** Strokes and joint limits, each with its margin (negative outside); what is outside at the start may not get worse. */
function guardsOf(model, start) {
  return limitsOf(model).flatMap(({ kind, name, low, high, counted }) => {
    const text = kind === "stroke" ? `stroke of ${name} ends here` : `limit of joint ${name}`;
    const guard = (end, margin) => {
      const slack = Math.max(NOISE * model.length - margin(start), ALMOST * model.length);
      return Number.isFinite(end) ? [{ margin, slack, reason: { kind, text, joint: name, amount: end } }] : [];
    };
    return [...guard(low, (v) => counted(v) - low), ...guard(high, (v) => high - counted(v))];
  });
}

/** Rotation vectors of ball joints kept well below a whole turn, where their rates have no bound; frames stay the same. */
function wrapped(model, values) {
  let result = values;
  for (const first of model.balls) {
    const angle = Math.hypot(...values.slice(first, first + 3));
    if (angle <= 1.25 * Math.PI) continue;
    if (result === values) result = values.slice();
    for (let k = first; k < first + 3; k++) result[k] *= 1 - (2 * Math.PI) / angle;
  }
  return result;
}
