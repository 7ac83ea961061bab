/** The mechanism as it stands: its joint values, its mode, and every way to move it. Knows nothing of the page. */

import { residual } from "./solver/closure.js";
import { frames, modelOf } from "./solver/frames.js";
import { inputsOf, toInputs, toPose } from "./solver/motion.js";
import { closestApproach } from "./solver/newton.js";
import { poseOf } from "./solver/pose.js";
import { nearestTurn } from "./solver/rotation.js";
import { distanceToSingular, measuresAt } from "./solver/rates.js";

const SAME = 1e-4;
const FREELY = { limits: false, through: true };

export class Mechanism {
  /** @param {object} scene @param {Function|null} kernel of the closed form's factors */
  constructor(scene, kernel) {
    this.scene = scene;
    this.model = modelOf(scene);
    this.kernel = kernel;
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
    const { assembly, working } = this.scene.branches;
    this.values = this.scene.home.slice();
    this.assembly = assembly.map((item) => ({ ...item, values: item.values.slice(), reached: true }));
    this.working = working;
    this.branch = 0;
    this.note({ status: "moved", reason: null });
    this.changed("mode");
    return this.state();
  }

  note({ status, reason }) {
    this.status = status;
    this.reason = reason;
  }

  get pose() {
    return poseOf(this.model, frames(this.model, this.values));
  }

  get inputs() {
    return inputsOf(this.model, this.values);
  }

  /** @param {number[]} printed inputs, lengths and rad; the assembly mode is kept */
  toInputs(printed) {
    return this.moved(toInputs(this.model, this.values, printed, this));
  }

  /** @param {number[]} pose lengths and rad; the working mode is kept */
  toPose(pose) {
    return this.moved(toPose(this.model, this.values, pose, this));
  }

  /** Straight to joint values that are nearly an assembly, as a link knows them; nothing where they are not. */
  restore(values, branch) {
    const closed = closestApproach(this.model, values, [], null);
    if (!(residual(this.model, closed) < 1e-9 * this.model.length)) return;
    this.branch = branch;
    this.jump(closed);
  }

  /** Straight to an assembly that is known. */
  jump(values) {
    this.values = values;
    this.note({ status: "moved", reason: null });
    this.changed("mode");
    return this.state();
  }

  moved(found) {
    this.values = found.values;
    this.note(found);
    this.changed("motion");
    return this.state();
  }

  /** Makes another assembly mode current, at the same inputs. @param {number} index */
  choose(index) {
    const item = this.assembly[index];
    if (!item) return this.state();
    const left = this.assembly[this.branch];
    Object.assign(left, { values: this.values, reached: true });
    const found = toInputs(this.model, item.values, this.inputs, { limits: false });
    if (found.status === "moved") {
      this.values = item.values = found.values;
      this.branch = index;
      this.note(found);
    } else
      this.note({
        status: "stopped",
        reason: { kind: "gap", text: `${item.label} does not exist at these inputs`, joint: "", amount: 0 },
      });
    this.changed("mode");
    return this.state();
  }

  /** Goes to another working mode, at the same pose. @param {number} index */
  work(index) {
    const item = this.working[index];
    if (!item) return this.state();
    const found = toPose(this.model, item.values, this.pose, FREELY);
    if (found.status === "moved") {
      this.values = found.values;
      this.note(found);
    } else
      this.note({
        status: "stopped",
        reason: { kind: "gap", text: `${item.label} does not reach this pose`, joint: "", amount: 0 },
      });
    this.changed("mode");
    return this.state();
  }

  /** Lets one other assembly follow the inputs. @returns {boolean} whether it still exists and differs from the current one */
  follow(index) {
    const item = this.assembly[index];
    const found = toInputs(this.model, item.values, this.inputs, { limits: false });
    item.values = found.values;
    item.reached = found.status === "moved" && !this.same(item.values, this.values);
    return item.reached;
  }

  /** Whether two assemblies have all their links at one place. */
  same(a, b) {
    const [first, second] = [frames(this.model, a), frames(this.model, b)];
    const near = (p, q, unit) => p.every((value, k) => Math.abs(value - q[k]) < SAME * unit);
    return first.every(
      (frame, k) => near(frame.origin, second[k].origin, this.model.length) && near(frame.turn, second[k].turn, 1),
    );
  }

  /** Index of the working mode in which the mechanism stands, -1 where none of the list is. */
  currentWork() {
    const pose = this.pose;
    return this.working.findIndex((item) => {
      const found = toPose(this.model, item.values, pose, FREELY);
      return found.status === "moved" && this.same(found.values, this.values);
    });
  }

  /** Factors of the closed form here, in the working mode whose inputs are the present ones. */
  factors() {
    const [pose, inputs] = [this.pose, this.inputs];
    const away = (found) =>
      Math.max(...found.inputs.map((value, k) => this.apart(value - inputs[k], this.model.inputs[k].kind)));
    const found = this.scene.modes.working.all
      .map((signs) => this.kernel(pose, this.scene.kernelParameters, signs))
      .filter((item) => away(item) < SAME);
    return found.length ? found[0].factors : {};
  }

  /** Of two inputs, without dimensions and whole turns. */
  apart(difference, kind) {
    return kind === "length" ? Math.abs(difference) / this.model.length : Math.abs(nearestTurn(difference));
  }

  /** The factor of the closed form that is nearest to zero, as a share of its scale. */
  nearestFactor() {
    if (!this.kernel) return null;
    const values = this.factors();
    const shares = this.scene.factors
      .map(({ name, scale }) => ({ name, value: values[name], share: Math.abs(values[name]) / scale }))
      .filter(({ share }) => Number.isFinite(share));
    return shares.reduce((least, item) => (!least || item.share < least.share ? item : least), null);
  }

  /** Everything that is known of the present configuration. */
  state() {
    if (!this.known) {
      const { condition, parallel, serial } = measuresAt(this.model, this.values);
      this.known = {
        values: this.values.slice(),
        pose: this.pose,
        inputs: this.inputs,
        residual: residual(this.model, this.values),
        status: this.status,
        reason: this.reason,
        condition,
        smallest: parallel,
        serial,
        get distance() {
          return this.far().amount;
        },
        factor: this.nearestFactor(),
      };
      let far = null;
      Object.defineProperty(this.known, "far", {
        value: () => (far ??= distanceToSingular(this.model, this.known.values)),
      });
    }
    return this.known;
  }
}
