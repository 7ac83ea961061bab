import assert from "node:assert/strict";
import { test } from "node:test";
import { Mechanism } from "../src/mechanism.js";
import { apart, MECHANISMS, mechanism } from "./numbers.js";
import { random } from "./walks.js";

const made = (name) => new Mechanism(mechanism(name).scene);

for (const { name, scene, named } of MECHANISMS.filter((item) => item.named.length))
  test(`${name}: in every working mode the assembly modes are named as Python names them, and all are shown`, () => {
    const it = new Mechanism(scene);
    for (const { at, working, current, assembly } of named) {
      const said = `${working} at ${at}`;
      it.reset();
      assert.equal(it.toPose(at).status, "moved", said);
      assert.equal(it.work(it.working.findIndex(({ label }) => label === working)).status, "moved", said);
      assert.equal(it.state().assembly, current, said);
      const shown = it.assembly.map((item, k) =>
        k === it.branch ? { label: item.label, values: it.values } : it.follow(k) && item,
      );
      const agree = shown.filter(
        (item) => item && assembly.some(({ label, values }) => label === item.label && it.same(values, item.values)),
      );
      assert.deepEqual(
        agree.map(({ label }) => label).sort(),
        assembly.map(({ label }) => label).sort(),
        said,
      );
      assert.equal(shown.length, assembly.length, said);
    }
  });

test("a link restores the name too, whatever it says itself", () => {
  for (const { at, working, current } of mechanism("fivebar").named) {
    const it = made("fivebar");
    it.toPose(at);
    const { values } = it.work(it.working.findIndex(({ label }) => label === working));
    for (const hint of [null, "+", "-"]) {
      const other = made("fivebar");
      other.restore(
        values.map((value) => value + 1e-7),
        hint,
      );
      assert.ok(apart(other.values, values) < 1e-6);
      assert.equal(other.state().assembly, current, `${working} at ${at}`);
    }
  }
});

test("a chosen assembly of another working mode is the one of the list, at the same inputs", () => {
  const it = made("fivebar");
  it.work(it.working.findIndex(({ label }) => label === "+-"));
  const inputs = it.inputs;
  assert.equal(it.state().assembly, "-");
  const there = it.choose(1);
  assert.equal(there.assembly, "+");
  assert.ok(apart(there.inputs, inputs) < 1e-9);
  assert.ok(Math.abs(there.pose[1] + 160.9) < 0.05); // the pose below
});

test("numbers that are none, and too few of them, are refused with what is wanted", () => {
  const it = made("fivebar");
  const { values } = it.state();
  for (const given of [[NaN, 0], [1], [1, 2, 3], [Infinity, 0], ["1", 2], undefined])
    assert.throws(() => it.toInputs(given), /toInputs: .*wanted are 2 finite numbers.*theta1, theta2/);
  assert.throws(() => it.toPose([0]), /toPose: .*wanted are 2 finite numbers.*x, y/);
  assert.deepEqual(it.state().values, values);
});

for (const { name, scene, model } of MECHANISMS.filter(({ scene }) => !scene.platform.pose.includes("qw")))
  test(`${name}: the working mode is known wherever the platform is led, also by a search`, () => {
    const draw = random(5);
    const it = new Mechanism(scene);
    let seen = 0;
    for (let work = 0; work < Math.min(3, it.working.length); work++) {
      it.reset();
      if (it.work(work).status !== "moved") continue;
      for (let step = 0; step < 4; step++) {
        it.toPose(scene.poseRange.map(([low, high]) => low + (high - low) * draw()));
        assert.equal(it.currentWork(), work);
        assert.equal(it.workHere().index, work);
        seen += 1;
      }
    }
    assert.ok(seen > 10);
    for (let step = 0; step < 5; step++) {
      it.toInputs(it.inputs.map((value, k) => value + (model.inputs[k].kind === "length" ? model.length : 2) * (draw() - 0.5)));
      const { index } = it.workHere();
      if (index >= 0) assert.equal(it.currentWork(), index);
    }
  });
