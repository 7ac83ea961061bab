/** The mechanism as it stands: its joint values, its mode, and every way to move it. Knows nothing of the page. */

import { residual } from "./solver/closure.js";
import { configurationAt, modelOf, resize } from "./solver/configuration.js";
import { exceeded, limitsOf } from "./solver/limits.js";
import { inputsOf, regularKinds, toInputs, toPose, toSizes } from "./solver/motion.js";
import { closestApproach, nearAssembly } from "./solver/newton.js";
import { poseOf } from "./solver/pose.js";
import { nearestTurn, placed, times } from "./solver/rotation.js";
import { conditionAt, nearness } from "./solver/rates.js";

const SAME = 1e-4;
const FREELY = { limits: false, through: true };
const AROUND = 0.2; // of the model's length, or rad: how far to the side a way goes that is blocked

/** What a caller gave, if it is as many numbers as have names. */
function numbers(name, given, wanted) {
  const found = Array.from(given ?? []);
  if (found.length === wanted.length && found.every((value) => Number.isFinite(value))) return found;
  const said = wanted.length === 1 ? "1 finite number" : `${wanted.length} finite numbers`;
  throw new Error(`${name}: [${found.join(", ")}] given; wanted are ${said}, lengths and rad: [${wanted.join(", ")}]`);
}

export class Mechanism {
  /** @param {object} scene its program of a configuration, and the kernel of a closed form's factors, as functions */
  constructor(scene) {
    this.scene = scene;
    this.model = modelOf(scene);
    this.sizes = this.model.sizes;
    this.home = poseOf(this.model, scene.home);
    regularKinds(this.model); // those of the file's dimensions
    this.limits = true;
    this.listeners = [];
    this.reset();
  }

  /** Calls back after every change, with whether the mode was changed by choice. */
  listen(call) {
    this.listeners.push(call);
  }

  changed(what) {
    this.known = null;
    for (const call of this.listeners) call(what);
  }

  /** Back to home in the first mode. */
  reset() {
    if (this.resized) resize(this.model, this.sizes);
    this.working = this.scene.branches.working;
    this.values = this.scene.home.slice();
    this.list(0);
    this.branch = 0;
    this.here = 0;
    this.note({ status: "moved", reason: null });
    this.changed("mode");
    return this.state();
  }

  /** Takes the assembly modes of a working mode, as they are at home's pose. */
  list(work) {
    const found = this.working[work].assembly ?? this.scene.branches.assembly;
    this.lone = this.working[work].lone ?? false;
    this.assembly = found.map((item) => ({ ...item, reached: true, fresh: true }));
  }

  /** Takes the assembly modes of a working mode whose first one was followed to where the mechanism stands, and finds
   * the current one: the first if no parallel singularity was on the way, else the one whose inputs lead here, or none. */
  settle(work, crossed, hint = null) {
    this.list(work);
    const said = (k) => Number(this.assembly[k].label !== hint);
    const order = [...this.assembly.keys()].sort((a, b) => said(a) - said(b));
    this.branch = crossed ? (order.find((k) => this.arrives(this.assembly[k])) ?? -1) : 0;
    return this.branch >= 0;
  }

  /** Lets one assembly follow the inputs; whether it is the one in which the mechanism stands. */
  arrives(item) {
    const arrived = () => this.same(item.values, this.values);
    return arrived() || (this.brought(item).status === "moved" && arrived());
  }

  /** Lets one assembly follow the inputs: straight, but round what is in the way when it comes from home's pose. */
  brought(item) {
    const { model, inputs } = this;
    const go = (values, to) => toInputs(model, values, to, { limits: false });
    const start = inputsOf(model, item.values);
    let found = go(item.values, inputs);
    for (const side of item.fresh ? [AROUND, -AROUND] : []) {
      if (found.status === "moved") break;
      // every input by another amount: what is in the way may lie on an axis of symmetry
      const aside = (k) => (side / (k + 1)) * (model.inputs[k].kind === "length" ? model.length : 1);
      const half = go(item.values, inputs.map((value, k) => (start[k] + value) / 2 + aside(k)));
      const whole = half.status === "moved" ? go(half.values, inputs) : half;
      if (whole.status === "moved") found = whole;
    }
    Object.assign(item, { values: found.values, fresh: false });
    return found;
  }

  note({ status, reason }) {
    Object.assign(this, { status, reason });
  }

  /** The name of the assembly mode in which it stands; empty where none of those of home's pose leads there. */
  get mode() {
    return this.assembly[this.branch]?.label ?? "";
  }

  get pose() {
    return poseOf(this.model, this.values);
  }

  get inputs() {
    return inputsOf(this.model, this.values);
  }

  /** To printed inputs, lengths and rad; the assembly mode is kept. */
  toInputs(printed) {
    const names = this.model.inputs.map(({ name }) => name);
    return this.moved(toInputs(this.model, this.values, numbers("toInputs", printed, names), this));
  }

  /** To a pose, lengths and rad; the working mode is kept. */
  toPose(pose) {
    return this.moved(toPose(this.model, this.values, numbers("toPose", pose, this.model.pose), this));
  }

  /** To other dimensions, lengths and rad, in the order of `sizes`; inputs are held, the assembly mode is kept. */
  toSizes(sizes) {
    const names = this.scene.sizes.map(({ name }) => name);
    const found = toSizes(this.model, this.values, numbers("toSizes", sizes, names), this);
    this.carry();
    return this.moved(found, "sizes");
  }

  /** Whether the dimensions are others than those of the file. */
  get resized() {
    return this.model.sizes.some((value, k) => value !== this.sizes[k]);
  }

  /** Takes the working modes along to other dimensions, at home's pose. */
  carry() {
    const carried = (values) => nearAssembly(this.model, values, [], this.home) ?? values;
    this.working = this.working.map((item) => ({ ...item, values: carried(item.values) }));
  }

  /** Straight to joint values that are nearly an assembly, as a link knows them, and whether they are.
   * @param {string|null} hint the name of the assembly mode that it says, to be tried first
   * @param {number[]|null} sizes other dimensions than those of the file */
  restore(values, hint, sizes = null) {
    if (sizes || this.resized) {
      resize(this.model, sizes ?? this.sizes);
      this.carry();
    }
    const closed = closestApproach(this.model, values, [], null);
    if (!(residual(this.model, closed) < 1e-9 * this.model.length)) return false;
    this.values = closed;
    const { index, crossed } = this.workHere();
    this.here = index < 0 ? null : index;
    if (index < 0 || !this.settle(index, crossed, hint))
      this.working.some((_, k) => k !== index && this.settle(k, true, hint));
    this.note({ status: "moved", reason: null });
    this.changed("mode");
    return true;
  }

  moved(found, what = "motion") {
    this.values = found.values;
    if (found.turned) this.here = null; // that working mode may have ended on the way
    this.note(found);
    this.changed(what);
    return this.state();
  }

  /** Makes another assembly mode current, at the same inputs. */
  choose(index) {
    const item = this.assembly[index];
    if (!item) return this.state();
    const left = this.assembly[this.branch];
    if (left) Object.assign(left, { values: this.values, reached: true, fresh: false });
    const take = () => Object.assign(this, { branch: index, here: null });
    return this.taken(this.brought(item), take, `${item.label} does not exist at these inputs`);
  }

  /** Goes to another working mode, at the same pose. */
  work(index) {
    const item = this.working[index];
    if (!item) return this.state();
    const found = toPose(this.model, item.values, this.pose, FREELY);
    const take = () => {
      this.here = index;
      this.settle(index, found.crossed);
    };
    const refusal = `${item.label} was not found here: the straight way from home’s pose ends before this one`;
    return this.taken(found, take, refusal);
  }

  /** Goes where a mode was followed to, or says that it is not to be had, where no joint is to blame. */
  taken(found, take, refusal) {
    if (found.status === "moved") {
      this.values = found.values;
      take();
      this.note(found);
    } else this.note({ status: "stopped", reason: { kind: "gap", text: refusal, joint: "", amount: 0 } });
    this.changed("mode");
    return this.state();
  }

  /** Lets one other assembly follow the inputs. @returns {boolean} whether it still exists and differs from the current one */
  follow(index) {
    const item = this.assembly[index];
    const found = this.brought(item);
    item.reached = found.status === "moved" && !this.same(item.values, this.values);
    return item.reached;
  }

  /** Whether two assemblies have all joints and the platform at one place; a rod may spin about its own line. */
  same(a, b) {
    const [first, second] = [a, b].map((values) => this.places(values));
    return first.every((value, k) => Math.abs(value - second[k]) < SAME);
  }

  /** Points of all joints in units of the model's length, on both links, the platform's orientation, counted turns. */
  places(values) {
    const { frames, platform } = configurationAt(this.model, values);
    const on = (link, at) => times(1 / this.model.length, placed(frames[link], at));
    const points = this.model.joints.flatMap((item) => [on(item.parent, item.at), on(item.child, item.childAt)]);
    const counted = values.filter((_, k) => this.model.coordinates[k].counted);
    return [...points.flat(), ...platform.turn, ...counted];
  }

  /** Index of the working mode in which the mechanism stands, -1 where none of the list is: the last one that was known
   * if no serial singularity has been passed since, else that in which the way back to home's pose ends. */
  currentWork() {
    if (this.here === null) {
      const { index, sure } = this.workHere();
      if (!sure) return index; // elsewhere it may be found
      this.here = index;
    }
    return this.here;
  }

  /** That index by going back to home's pose, -1 also where there is no way (it is not sure then); and whether a parallel
   * singularity is on the way. */
  workHere() {
    const { status, values, crossed } = toPose(this.model, this.values, this.home, FREELY);
    const index = status === "moved" ? this.working.findIndex((item) => this.same(item.values, values)) : -1;
    return { index, crossed, sure: status === "moved" };
  }

  /** Factors of the closed form here, in the working mode whose inputs are the present ones. */
  factors() {
    const [pose, inputs] = [this.pose, this.inputs];
    const here = (value, k) => this.apart(value - inputs[k], this.model.inputs[k]) < SAME;
    return this.scene.modes.working.all
      .map((signs) => this.scene.kernel(pose, this.model.kernel, signs))
      .find((found) => found.inputs.every(here))?.factors;
  }

  /** Of two inputs, without dimensions, and without whole turns where these do not count. */
  apart(difference, { kind, counted }) {
    if (kind === "length") return Math.abs(difference) / this.model.length;
    return Math.abs(counted ? difference : nearestTurn(difference));
  }

  /** The factor of the closed form that is nearest to zero, as a share of its scale. */
  nearestFactor() {
    const values = this.scene.kernel && this.factors();
    if (!values) return null;
    const shares = this.scene.factors
      .map(({ name, scale }) => ({ name, value: values[name], share: Math.abs(values[name]) / scale }))
      .filter(({ share }) => Number.isFinite(share));
    return shares.sort((a, b) => a.share - b.share)[0] ?? null;
  }

  /** Everything that is known of the present configuration. */
  state() {
    if (this.known) return this.known;
    const { model, values, pose, inputs, status, reason } = this;
    const { parallel, serial } = nearness(model, values);
    const assembly = this.assembly[this.branch]?.label ?? null;
    const limits = { stated: limitsOf(model).length > 0, exceeded: exceeded(model, values) };
    const measures = { condition: conditionAt(model, values), smallest: parallel, serial, factor: this.nearestFactor() };
    const stands = { values: values.slice(), pose, inputs, residual: residual(model, values), assembly };
    return (this.known = { ...stands, status, reason, limits, ...measures });
  }
}
